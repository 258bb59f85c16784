#pragma once
// Many-to-many sweeps of one solid along whatever path there is.
#include "support/catch.hpp"
#include "support/dice.hpp"
#include "support/occ_solids.hpp"

#include <pavior/brep/chord_volume.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <exception>
#include <iostream>
#include <optional>
#include <set>
#include <string>

namespace pavior::test {

inline BestMultiSweep swept(const GmshBrep& model, double size) {
    MultiSweepOptions options;
    options.size = size;
    const auto solver = [](const IntegerProgram& program) { return solve(program, {5, 1e-3}); };
    return best_multi_sweep(model, all_solids(model), options, imprint, solver, GmshRegionMesher{},
                            [] { return false; });
}

/// The faces that have quads.
inline std::set<FaceId> meshed_faces(const MultiSweptModel& swept) {
    return {swept.quad_face.begin(), swept.quad_face.end()};
}

/// Conforming, not inverted, nodes on their faces, volume within the chords.
inline bool sound(const GmshBrep& model, const MultiSweptModel& swept) {
    const HexReport report = verify_hexes(swept.mesh);
    const double error = std::abs(report.volume - model.solid_volume(SolidId{0}));
    INFO(report.text());
    CHECK(face_distance(model, swept.mesh.nodes, swept.quads, swept.quad_face).distance < 1e-6);
    CHECK(chord_volume(model, swept.mesh.nodes, swept.quads, swept.quad_face, error) >= error);
    return report.ok() && hex_quality(swept.mesh).scaled_jacobian.min > 0;
}

/// Makes a solid of each seed (make(seed), by OpenCASCADE) and sweeps it along a path that is \p wanted(path): nine of
/// ten that the kernel can make must become sound meshes of all faces. Prints the seeds.
template <class Make, class Wanted>
void sweep_seeds(const std::string& what, const Seeds& range, double size, Make&& make, Wanted&& wanted) {
    unsigned valid = 0;
    unsigned asked = 0;
    for (unsigned seed = range.first; seed <= range.last(); ++seed) {
        CAPTURE(seed);
        std::optional<GmshBrep> model;
        try {
            model = GmshBrep::build([&] { make(seed); });
        } catch (const std::exception& error) {
            std::cerr << what << " " << seed << ": no model, " << error.what() << "\n";
            continue;
        }
        ++asked;
        std::string outcome;
        try {
            const BestMultiSweep best = swept(*model, size);
            if (!best.mesh) {
                throw no_mesh_error(best);
            }
            const bool good = wanted(best.mesh->path) && sound(*model, *best.mesh) &&
                              meshed_faces(*best.mesh).size() == model->face_count();
            valid += good ? 1 : 0;
            outcome = (good ? ": " : " FAILED: ") + std::to_string(best.mesh->mesh.hexes.size()) + " hexahedra, " +
                      std::to_string(hex_quality(best.mesh->mesh).scaled_jacobian.min);
        } catch (const UnmeshableError& error) {
            outcome = std::string(" FAILED: ") + error.what();
        }
        std::cerr << what << " " << seed << outcome << "\n";
    }
    std::cerr << "of " << asked << " " << what << "s " << valid << " valid\n";
    CHECK(10 * valid >= 9 * asked);
}

}  // namespace pavior::test

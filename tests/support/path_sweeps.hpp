#pragma once
// Many-to-many sweeps of one solid along whatever path there is.
#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/model/chord_volume.hpp>
#include <pavior/model/integer_program.hpp>
#include <pavior/model/multi_sweep_model.hpp>

namespace pavior::test {

inline BestMultiSweep swept(const GmshBrep& model, double size) {
    MultiSweepOptions options;
    options.size = size;
    const auto solver = [](const IntegerProgram& program) { return solve(program, {5, 1e-3}); };
    return best_multi_sweep(model, all_solids(model), options, imprint, solver, GmshRegionMesher{},
                            [] { return false; });
}

/// Conforming, not inverted, nodes within \p off of their faces, volume within the chords.
inline bool sound(const GmshBrep& model, const MultiSweptModel& swept, double off = 1e-6) {
    const HexReport report = verify_hexes(swept.mesh);
    const double error = std::abs(report.volume - model.solid_volume(SolidId{0}));
    INFO(report.text());
    CHECK(face_distance(model, swept.mesh.nodes, swept.quads, swept.quad_face).distance < off);
    CHECK(chord_volume(model, swept.mesh.nodes, swept.quads, swept.quad_face, error) >= error);
    return report.ok() && hex_quality(swept.mesh).scaled_jacobian.min > 0;
}

}  // namespace pavior::test

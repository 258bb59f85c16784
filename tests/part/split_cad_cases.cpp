// The last resort on CAD files: features are kept, assemblies conform, the same bytes for any number of threads.
#include "support/catch.hpp"
#include "support/feature_checks.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/mesh_file.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

const std::string examples = PAVIOR_EXAMPLE_DATA;

PartMesh split(const GmshBrep& model, double size, unsigned threads = 1) {
    PartOptions options;
    options.size = size;
    options.methods = {PartMethod::split};
    options.execution.threads = threads;
    return mesh_model(model, options);
}

}  // namespace

TEST_CASE("A drilled cube keeps its circles and corners, and its hole is round") {
    const GmshBrep model = GmshBrep::load(examples + "/hexme/s11o_cube_cyl.stp");
    const PartMesh part = split(model, 2.5);
    INFO(reason_of(part));
    REQUIRE(part.valid());
    check_features(model, part, 2.5);
    CHECK(part.check.quality.scaled_jacobian.min >= 0.2);
    REQUIRE(part.deviation.relative_volume());
    CHECK(std::abs(*part.deviation.relative_volume()) < 0.02);
    const MethodTry& taken = part.decisions[0].tries[0];
    CHECK(taken.warnings.empty());
    const PartMesh two = split(model, 2.5, 2);
    CHECK(two.data.mesh.nodes == part.data.mesh.nodes);
    CHECK(two.data.mesh.hexes == part.data.mesh.hexes);
    CHECK(two.data.quads == part.data.quads);
}

TEST_CASE("An assembly is split as one: it conforms across all shared faces, with the groups of its solids") {
    const GmshBrep model = GmshBrep::load(examples + "/assembly/bolt_plate_washer.step");
    const PartMesh part = split(model, 4);
    INFO(reason_of(part));
    REQUIRE(part.valid());
    CHECK(part.decisions.size() == 1);
    check_features(model, part, 4);
    CHECK(std::set<int>(part.data.hex_groups.begin(), part.data.hex_groups.end()).size() == 3);
    CHECK(verify_hexes(part.data.mesh).ok());
    CHECK(part.data.quads.size() > part.check.verify.boundary_quads);  // those between solids, once
    std::set<QuadCorners> different;
    for (QuadCorners quad : part.data.quads) {
        std::sort(quad.begin(), quad.end());
        different.insert(quad);
    }
    CHECK(different.size() == part.data.quads.size());
    REQUIRE(part.deviation.relative_volume());
    CHECK(std::abs(*part.deviation.relative_volume()) < 0.02);
}

TEST_CASE("The tip of a cone and the pole of a ball") {
    for (const auto& [name, size] : {std::pair("cone_full.step", 0.3), {"sphere.step", 0.4}}) {
        CAPTURE(name);
        const GmshBrep model = GmshBrep::load(std::string(PAVIOR_TEST_DATA).append("/faults/").append(name));
        const double wanted = size * model.diagonal() / 4;
        const PartMesh part = split(model, wanted);
        INFO(reason_of(part));
        REQUIRE(part.valid());
        check_features(model, part, wanted);
        CHECK(part.check.quality.scaled_jacobian.min > 0.1);
    }
}

TEST_CASE("A local size of a face makes more hexahedra, fewer than the whole at that size") {
    const GmshBrep model = GmshBrep::load(examples + "/mfcad/4-4-19.step");
    PartOptions options;
    options.size = 2;
    options.methods = {PartMethod::split};
    const std::size_t coarse = mesh_model(model, options).check.hexahedra;
    options.local.face[1] = 0.7;
    const PartMesh local = mesh_model(model, options);
    REQUIRE(local.valid());
    CHECK(local.check.hexahedra > coarse + coarse / 4);
    check_features(model, local, 2);
    options.max_hexahedra = 0.9 * static_cast<double>(local.check.hexahedra);
    options.local = {};
    options.size = 0.9;
    const PartMesh many = mesh_model(model, options);
    CHECK((!many.complete() || static_cast<double>(many.check.hexahedra) <= options.max_hexahedra));
}

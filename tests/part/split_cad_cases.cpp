// The last resort on CAD files: features are kept, assemblies conform, the same bytes for any number of threads.
#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/mesh_file.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;

namespace {

const std::string examples = PAVIOR_EXAMPLE_DATA;

PartMesh split(const GmshBrep& model, double size, unsigned threads = 1) {
    PartOptions options;
    options.size = size;
    options.methods = {PartMethod::split};
    options.execution.threads = threads;
    return mesh_model(model, options);
}

/// Every edge of the model between different faces is a chain of mesh edges whose nodes lie on it, every vertex a node.
void check_features(const GmshBrep& model, const PartMesh& part, double size) {
    CHECK(part.entities.distance < 1e-6 * size);
    std::set<std::pair<Index, Index>> joined;
    for (const QuadCorners& quad : part.data.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            joined.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
        }
    }
    std::map<std::int32_t, Index> vertex;
    std::map<std::int32_t, std::vector<std::pair<double, Index>>> on_edge;
    for (Index i = 0; i < part.entities.of_node.size(); ++i) {
        const NodeEntity& on = part.entities.of_node[i];
        if (on.dimension == 0) {
            vertex[on.id] = i;
        } else if (on.dimension == 1) {
            on_edge[on.id].emplace_back(on.uv[0], i);
        }
    }
    std::map<EdgeId, std::set<FaceId>> faces;
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        for (const EdgeLoop& loop : model.face_loops(FaceId{static_cast<std::int32_t>(f)})) {
            for (const OrientedEdge& use : loop) {
                faces[use.edge].insert(FaceId{static_cast<std::int32_t>(f)});
            }
        }
    }
    for (const auto& [edge, around] : faces) {
        if (around.size() < 2) {
            continue;
        }
        const auto ends = model.edge_vertices(edge);
        REQUIRE(vertex.contains(ends[0].value));
        REQUIRE(vertex.contains(ends[1].value));
        auto chain = on_edge[edge.value];
        std::sort(chain.begin(), chain.end());
        std::vector<Index> nodes{vertex[ends[0].value]};
        for (const auto& [t, i] : chain) {
            nodes.push_back(i);
        }
        nodes.push_back(vertex[ends[1].value]);
        REQUIRE(nodes.size() > 2);
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
            CAPTURE(edge.value, k);
            CHECK(joined.contains(std::minmax(nodes[k], nodes[k + 1])));
        }
    }
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

#include <pavior/one_to_one/layer_path.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/recognition.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Layers with n intervals on every edge.
int layers(const LayerPath& way, int n) {
    int sum = 0;
    for (const auto& [use, rows] : way.edges) {
        sum += n * rows;
    }
    return sum;
}

SweepTopology upright(const TestBrep& b) {
    return sweep_between(b, SolidId{0}, b.solid_faces(SolidId{0})[0].face, b.solid_faces(SolidId{0})[1].face);
}

}  // namespace

TEST_CASE("a way leads up the first rib, storey by storey") {
    TestBrep b;
    add_prism(b, l_shape(), 0, 3, {{{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}}}, 3);
    const SweepTopology sweep = upright(b);
    for (const std::size_t loop : {0U, 1U}) {
        const LayerPath way = layer_path(b, sweep, loop);
        REQUIRE(way.edges.size() == 3);
        CHECK(layers(way, 4) == 12);
        VertexId at = first_vertex(b, sweep.source_loops[loop].front());
        for (const auto& [use, rows] : way.edges) {
            CHECK(rows == 1);
            CHECK(first_vertex(b, use) == at);
            at = last_vertex(b, use);
        }
        CHECK(b.vertex_point(at)[2] == 3);
        CHECK(way.faces.size() == 3);
    }
}

TEST_CASE("a way steps aside where no rib goes on") {
    TestBrep b;
    add_half_stacked_box(b);
    const LayerPath way = layer_path(b, upright(b), 0);
    CHECK(layers(way, 1) >= 1);
    double height = 0;
    for (const auto& [use, rows] : way.edges) {
        height += b.vertex_point(last_vertex(b, use))[2] - b.vertex_point(first_vertex(b, use))[2];
    }
    CHECK(height == Approx(1));
    CHECK(way.edges.size() == way.faces.size());
}

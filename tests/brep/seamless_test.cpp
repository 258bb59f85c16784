#include "support/catch.hpp"

#include <pavior/brep/seamless.hpp>

#include <array>
#include <cstddef>
#include <vector>

using namespace pavior;

namespace {

OrientedEdge use(int edge, bool forward = true) { return {EdgeId{edge}, forward}; }

/// A can with a dome: 0 bottom (edge 0), 1 wall (0, seam 1, 2), 2 dome (2, seam 3 to the pole).
SolidBoundary can() {
    SolidBoundary solid;
    solid.faces.resize(3);
    const auto add = [&](std::size_t f, const std::vector<std::pair<OrientedEdge, double>>& loop) {
        SolidBoundary::Face& face = solid.faces[f];
        face.begin = solid.half_edges.size();
        face.loops.push_back(face.begin);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            SolidBoundary::HalfEdge h;
            h.use = loop[i].first;
            h.angle = loop[i].second;
            h.face = f;
            h.next = face.begin + (i + 1) % loop.size();
            solid.half_edges.push_back(h);
        }
        face.end = solid.half_edges.size();
    };
    add(0, {{use(0, false), 180}});
    add(1, {{use(0), 90}, {use(1), 90}, {use(2, false), 90}, {use(1, false), 90}});
    add(2, {{use(3), 80}, {use(3, false), 360}, {use(2), 100}});
    solid.faces[1].seam = solid.faces[2].seam = true;
    for (SolidBoundary::HalfEdge& h : solid.half_edges) {
        for (std::size_t t = 0; t < solid.half_edges.size(); ++t) {
            const OrientedEdge other = solid.half_edges[t].use;
            h.twin = other.edge == h.use.edge && other.forward != h.use.forward ? t : h.twin;
        }
    }
    return solid;
}

}  // namespace

TEST_CASE("Loops go on behind a seam") {
    using Loops = std::vector<EdgeLoop>;
    CHECK(seamless_loops(Loops{{use(0), use(1), use(1, false)}}) == Loops{{use(0)}});
    CHECK(seamless_loops(Loops{{use(1), use(0), use(1, false), use(2)}}) == Loops{{use(0)}, {use(2)}});
    const Loops plain{{use(0), use(1), use(2)}, {use(3, false), use(4)}};
    CHECK(seamless_loops(plain) == plain);
    // the seam runs over a vertex, and the rim comes in two pieces
    CHECK(seamless_loops(Loops{{use(0), use(1), use(2), use(2, false), use(1, false), use(3)}}) ==
          Loops{{use(0), use(3)}});
    CHECK(seamless_loops(Loops{{use(0), use(0, false)}}).empty());
}

TEST_CASE("A dome without its seam is bounded by its rim, the wall keeps its own") {
    const SolidBoundary solid = can();
    const SolidBoundary seamless = without_seams(solid, std::array<std::size_t, 2>{0, 2});
    REQUIRE(seamless.half_edges.size() == 6);
    CHECK(!seamless.faces[2].seam);
    CHECK(seamless.faces[1].seam);
    CHECK(seamless.faces[2].begin == 5);
    CHECK(seamless.faces[2].end == 6);
    CHECK(seamless.faces[2].loops == std::vector<std::size_t>{5});
    const SolidBoundary::HalfEdge& rim = seamless.half_edges[5];
    CHECK(rim.use == use(2));
    CHECK(rim.next == 5);
    CHECK(rim.angle == 180);
    CHECK(seamless.half_edges[rim.twin].use == use(2, false));
    for (std::size_t h = 0; h < 5; ++h) {
        CHECK(seamless.half_edges[h].use == solid.half_edges[h].use);
        CHECK(seamless.half_edges[h].next == solid.half_edges[h].next);
        CHECK(seamless.half_edges[h].angle == solid.half_edges[h].angle);
        CHECK(seamless.half_edges[seamless.half_edges[h].twin].twin == h);
    }
    CHECK(seamless.loop_from(1) == std::vector<std::size_t>{1, 2, 3, 4});
}

#include <pavior/lattice/grid_laplace.hpp>
#include <pavior/lattice/submap_polygon.hpp>

#include "support/catch.hpp"

#include <pavior/mesh/eigen_access.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <cmath>
#include <map>

using namespace pavior;

namespace {

using Polygon = std::vector<Vec2>;

/// The polygon with each side cut into pieces.
Polygon divided(const Polygon& corners, const std::vector<int>& pieces) {
    Polygon result;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        for (int k = 0; k < pieces[i]; ++k) {
            result.push_back(a + (b - a) * k / pieces[i]);
        }
    }
    return result;
}

QuadMesh lifted(const PolygonQuads& mesh) {
    QuadMesh result{{}, mesh.quads};
    for (const Vec2& p : mesh.nodes) {
        result.nodes.emplace_back(p[0], p[1], 0.0);
    }
    return result;
}

double area(const PolygonQuads& mesh) {
    double sum = 0.0;
    for (const QuadCorners& q : mesh.quads) {
        const Vec2 a = mesh.nodes[q[2]] - mesh.nodes[q[0]], b = mesh.nodes[q[3]] - mesh.nodes[q[1]];
        sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
}

/// Sound, covers `wanted`, no quad inverted, four quads round every node that is not a point of the input.
void check(const PolygonQuads& mesh, const std::vector<Polygon>& loops, double wanted) {
    const QuadReport report = verify_quads(lifted(mesh));
    INFO(report.text());
    CHECK(report.ok());
    CHECK(area(mesh) == Approx(wanted).epsilon(1e-12));
    CHECK(mesh.smooth.inverted_after == 0);
    std::vector<int> valence(mesh.nodes.size(), 0);
    for (const QuadCorners& q : mesh.quads) {
        for (const Index n : q) {
            ++valence[n];
        }
    }
    std::vector<bool> outer(mesh.nodes.size(), false);
    REQUIRE(mesh.loops.size() == loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            const Index n = mesh.loops[l][i];
            outer[n] = true;
            CHECK(mesh.nodes[n] == loops[l][i]);
            CHECK(valence[n] == static_cast<int>(mesh.classes[l][i]));
        }
    }
    for (std::size_t n = 0; n < outer.size(); ++n) {
        CHECK((outer[n] || valence[n] == 4));
    }
}

}  // namespace

TEST_CASE("a rectangle") {
    const std::vector<Polygon> loops{divided({{0, 0}, {3, 0}, {3, 1}, {0, 1}}, {3, 2, 3, 2})};
    const PolygonQuads mesh = submap_polygon(loops);
    check(mesh, loops, 3.0);
    CHECK(mesh.quads.size() == 6);
    CHECK(mesh.lattice[11] == LatticePoint<2>{3, 2});
    CHECK((mesh.nodes[5] - Vec2(1, 0.5)).norm() < 1e-12);
}

TEST_CASE("an L, turned by any angle") {
    for (const double angle : {0.0, 0.4, 2.0, 4.0}) {
        const Eigen::Matrix2d turn =
            (Eigen::Matrix2d() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
        Polygon l = divided({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}}, {4, 2, 2, 3, 2, 5});
        for (Vec2& p : l) {
            p = turn * p;
        }
        const std::vector<Polygon> loops{l};
        const PolygonQuads mesh = submap_polygon(loops);
        check(mesh, loops, 14.0);
        CHECK(mesh.quads.size() == 14);
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            CHECK((turn.transpose() * mesh.nodes[n] - Vec2(mesh.lattice[n][0], mesh.lattice[n][1])).norm() < 1e-9);
        }
    }
}

TEST_CASE("holes find their places") {
    const std::vector<Polygon> loops{divided({{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {10, 6, 10, 6}),
                                     divided({{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {2, 2, 2, 2}),
                                     divided({{9, 1}, {6, 1}, {6, 5}, {9, 5}}, {3, 4, 3, 4})};
    const PolygonQuads mesh = submap_polygon(loops);
    check(mesh, loops, 60 - 4 - 12);
    CHECK(mesh.quads.size() == 60 - 4 - 12);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        CHECK((mesh.nodes[n] - Vec2(mesh.lattice[n][0], mesh.lattice[n][1])).norm() < 1e-9);
    }
}

TEST_CASE("a hole divided too finely for its place is moved where there is room, or refused") {
    std::vector<Polygon> loops{divided({{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {6, 6, 6, 6}),
                               divided({{1, 1}, {1, 3}, {3, 3}, {3, 1}}, {4, 4, 4, 4})};
    check(submap_polygon(loops), loops, 32.0);
    loops[1] = divided({{1, 1}, {1, 3}, {3, 3}, {3, 1}}, {5, 5, 5, 5});
    try {
        (void)submap_polygon(loops);
        FAIL("a hole of 5 x 5 has no room in 6 x 6");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::not_submappable);
        CHECK(e.ids() == Error::Ids{1});
    }
}

TEST_CASE("a bent strip with a step follows its arcs") {
    Polygon strip;  // inner radius 4, outer 6, then 7 from the middle on; a quarter of a ring
    const auto at = [](double r, double t) { return Vec2(r * std::cos(t), r * std::sin(t)); };
    const double quarter = std::acos(0.0);
    for (int i = 0; i < 3; ++i) {
        strip.push_back(at(4 + i, 0));
    }
    strip.pop_back();
    for (int i = 0; i < 6; ++i) {
        strip.push_back(at(6, quarter * i / 12));
    }
    strip.push_back(at(6, quarter / 2));
    for (int i = 0; i < 6; ++i) {
        strip.push_back(at(7, quarter * (6 + i) / 12));
    }
    for (int i = 0; i < 3; ++i) {
        strip.push_back(at(7 - i, quarter));
    }
    for (int i = 0; i < 12; ++i) {
        strip.push_back(at(4, quarter * (12 - i) / 12));
    }
    const std::vector<Polygon> loops{strip};
    const PolygonQuads mesh = submap_polygon(loops);
    double wanted = 0.0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
        const Vec2 &a = strip[i], &b = strip[(i + 1) % strip.size()];
        wanted += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    check(mesh, loops, wanted);
    CHECK(mesh.quads.size() == 24 + 6);
    CHECK(mesh.smooth.min_det_after > 0.7);
}

TEST_CASE("segments that do not balance are counted in the message") {
    const std::vector<Polygon> loops{divided({{0, 0}, {3, 0}, {3, 1}, {0, 1}}, {3, 2, 4, 2})};
    try {
        (void)submap_polygon(loops);
        FAIL("3 and 4 segments do not balance");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::infeasible_intervals);
        CHECK(std::string(e.what()).find("3 segments along its first direction and 4 against") != std::string::npos);
    }
    const std::vector<Polygon> triangle{divided({{0, 0}, {3, 0}, {1, 2}}, {3, 3, 3})};
    CHECK_THROWS_AS(submap_polygon(triangle), UnmeshableError);
}

TEST_CASE("classes given by the caller override the angles") {
    const std::vector<Polygon> loops{divided({{0, 0}, {2, 0}, {3, 2}, {0, 3}}, {2, 2, 2, 2})};
    std::vector<std::vector<CornerClass>> classes{std::vector<CornerClass>(8, CornerClass::side)};
    for (const std::size_t i : {1U, 3U, 5U, 7U}) {
        classes[0][i] = CornerClass::end;  // corners in the middles of the sides
    }
    const PolygonQuads mesh = submap_polygon(loops, classes);
    CHECK(mesh.quads.size() == 4);
    CHECK(mesh.classes == classes);
    classes[0].pop_back();
    CHECK_THROWS_AS(submap_polygon(loops, classes), InputError);
}

TEST_CASE("input that is no polygon") {
    CHECK_THROWS_AS(submap_polygon(std::vector<Polygon>{}), InputError);
    CHECK_THROWS_AS(submap_polygon(std::vector<Polygon>{{{0, 0}, {1, 0}, {1, 1}, {0, std::nan("")}}}), InputError);
}

#include "support/catch.hpp"
#include "tet_checks.hpp"

#include <pavior/tetra/check_surface.hpp>

#include <limits>

using namespace pavior;

namespace {

using Item = SurfaceFinding::Item;

SurfaceReport check(const TaggedSurface& surface) { return check_surface(surface.mesh); }

/// The only finding of a report must be this one.
void check_only(const SurfaceReport& report, SurfaceFault fault, std::size_t count, const std::vector<Item>& items) {
    CAPTURE(report.text());
    REQUIRE(report.findings().size() == 1);
    const SurfaceFinding& finding = report.findings().front();
    CHECK(finding.fault == fault);
    CHECK(finding.count == count);
    CHECK(finding.items == items);
    CHECK_FALSE(report.ok());
    CHECK(report.find(fault) == &finding);
    CHECK(report.count(fault) == count);
    try {
        report.throw_if_bad();
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == error_code(fault));
        CHECK_FALSE(error.ids().empty());
        CHECK(std::string(error.what()).find(std::string(to_string(fault))) != std::string::npos);
    }
}

/// A mesh as others have it: floats and 64-bit ids.
struct Foreign {
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<long long, 3>> faces;
};

}  // namespace

template <>
struct pavior::mesh_access<Foreign> {
    static std::size_t node_count(const Foreign& m) { return m.points.size(); }
    static const auto& node(const Foreign& m, Index i) { return m.points[i]; }
    static std::size_t triangle_count(const Foreign& m) { return m.faces.size(); }
    static std::array<Index, 3> triangle(const Foreign& m, Index t) {
        return {static_cast<Index>(m.faces[t][0]), static_cast<Index>(m.faces[t][1]),
                static_cast<Index>(m.faces[t][2])};
    }
};

TEST_CASE("Sound surfaces have no findings") {
    for (const std::string& name : tets::names()) {
        for (const int turn : {0, 1}) {
            const SurfaceReport report = check(tets::turned(tets::load(name + ".off"), turn));
            CAPTURE(name, turn, report.text());
            CHECK(report.ok());
            CHECK(report.text().empty());
            CHECK_NOTHROW(report.throw_if_bad());
        }
    }
}

TEST_CASE("Any triangle mesh can be checked") {
    Foreign tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    CHECK(check_surface(tetrahedron).ok());
    std::swap(tetrahedron.faces[1][0], tetrahedron.faces[1][1]);
    CHECK(check_surface(tetrahedron).count(SurfaceFault::same_sense) == 3);
}

TEST_CASE("Faults of single triangles") {
    TaggedSurface s = tets::box();
    CHECK(check(TaggedSurface{}).find(SurfaceFault::empty) != nullptr);
    s.mesh.nodes[0].y() = std::numeric_limits<double>::infinity();
    check_only(check(s), SurfaceFault::not_finite, 6,
               {{{0}, {}}, {{1}, {}}, {{4}, {}}, {{5}, {}}, {{8}, {}}, {{9}, {}}});
    s = tets::box();
    s.mesh.triangles[3][2] = 8;
    s.mesh.triangles[5][0] = 0xFFFFFFFFU;
    check_only(check(s), SurfaceFault::id_out_of_range, 2, {{{3}, {}}, {{5}, {}}});
    s = tets::box();
    s.mesh.triangles[3][2] = s.mesh.triangles[3][0];
    check_only(check(s), SurfaceFault::repeated_node, 1, {{{3}, {}}});
    s = tets::box();
    s.mesh.nodes.emplace_back(5, 5, 5);
    check_only(check(s), SurfaceFault::unused_node, 1, {{{}, {8}}});
}

TEST_CASE("A triangle whose corners lie on a line") {
    // Edge 0 1 of the box is split on one side only; a sliver closes the gap.
    TaggedSurface s = tets::box();
    s.mesh.nodes.emplace_back(0.5, 0, 0);
    s.mesh.triangles[4] = {0, 8, 5};  // side y = 0: 0 1 5 and 0 5 4
    s.mesh.triangles.push_back({8, 1, 5});
    s.mesh.triangles.push_back({0, 1, 8});
    CHECK(check(s).findings().front().fault == SurfaceFault::degenerate);
    CHECK(check(s).findings().front().items == std::vector<Item>{{{13}, {}}});
    s.mesh.nodes[8].z() = 1e-17;
    CHECK(check(s).count(SurfaceFault::degenerate) == 1);
    s.mesh.nodes[8].y() = 1e-6;
    CHECK(check(s).ok());
}

TEST_CASE("Open, doubled and turned triangles") {
    TaggedSurface s = tets::box();
    s.mesh.triangles.erase(s.mesh.triangles.begin() + 11);
    check_only(check(s), SurfaceFault::open_edge, 3, {{{0}, {4, 6}}, {{10}, {4, 7}}, {{6}, {6, 7}}});
    s = tets::box();
    s.mesh.triangles.push_back({6, 4, 0});  // triangle 0 turned
    const SurfaceReport doubled = check(s);
    CAPTURE(doubled.text());
    REQUIRE(doubled.find(SurfaceFault::duplicate) != nullptr);
    CHECK(doubled.find(SurfaceFault::duplicate)->items == std::vector<Item>{{{0, 12}, {}}});
    CHECK(doubled.count(SurfaceFault::overused_edge) == 3);
    s = tets::box();
    std::swap(s.mesh.triangles[0][1], s.mesh.triangles[0][2]);
    check_only(check(s), SurfaceFault::same_sense, 3, {{{0, 5}, {0, 4}}, {{0, 1}, {0, 6}}, {{0, 11}, {4, 6}}});
}

TEST_CASE("Two shells that touch at an edge, welded or not") {
    const TaggedSurface a = tets::box();
    const TaggedSurface b = tets::box(Vec3(1, 1, 0), Vec3(2, 2, 1));
    TaggedSurface both = tets::joined(a, b);
    const SurfaceReport apart = check(both);
    CAPTURE(apart.text());
    REQUIRE(apart.find(SurfaceFault::coincident_nodes) != nullptr);
    CHECK(apart.findings().front().items == std::vector<Item>{{{2, 12}, {3, 8}}, {{2, 12}, {7, 12}}});
    for (TriCorners& c : both.mesh.triangles) {
        for (Index& node : c) {
            node = node == 8 ? 3 : node == 12 ? 7 : node < 8 ? node : node < 12 ? node - 1 : node - 2;
        }
    }
    both.mesh.nodes.erase(both.mesh.nodes.begin() + 12);
    both.mesh.nodes.erase(both.mesh.nodes.begin() + 8);
    const SurfaceReport welded = check(both);
    CAPTURE(welded.text());
    REQUIRE(welded.findings().size() == 1);
    CHECK(welded.findings().front().fault == SurfaceFault::overused_edge);
    CHECK(welded.findings().front().items.front().nodes == std::vector<Index>{3, 7});
    CHECK(welded.findings().front().items.front().triangles.size() == 4);
}

TEST_CASE("Two shells that touch at a node, and in the middle of a face") {
    const TaggedSurface a = tets::box();
    TaggedSurface corner = tets::joined(a, tets::box(Vec3::Ones(), Vec3::Constant(2)));
    CHECK(check(corner).findings().front().fault == SurfaceFault::coincident_nodes);
    for (TriCorners& c : corner.mesh.triangles) {
        for (Index& node : c) {
            node = node == 8 ? 7 : node < 8 ? node : node - 1;
        }
    }
    corner.mesh.nodes.erase(corner.mesh.nodes.begin() + 8);
    check_only(check(corner), SurfaceFault::touching_node, 1, {{{2, 12}, {7}}});

    const TaggedSurface faces = tets::joined(a, tets::box(Vec3(1, 0.2, 0.2), Vec3(2, 0.7, 0.8)));
    const SurfaceReport report = check(faces);
    CHECK(report.findings().front().fault == SurfaceFault::intersection);
    for (const Item& item : report.findings().front().items) {
        CHECK(item.triangles.size() == 2);
    }
}

TEST_CASE("Shells that cross") {
    const TaggedSurface both = tets::joined(tets::box(), tets::box(Vec3::Constant(0.5), Vec3::Constant(2)));
    const SurfaceReport report = check(both);
    CAPTURE(report.text());
    REQUIRE(report.findings().size() == 1);
    CHECK(report.findings().front().fault == SurfaceFault::intersection);
    for (const Item& item : report.findings().front().items) {
        CHECK(item.triangles[0] < 12);
        CHECK(item.triangles[1] >= 12);
    }
    // The same at other scales.
    for (const double scale : {1e-200, 1e9, 1e300}) {
        TaggedSurface scaled = both;
        for (Vec3& x : scaled.mesh.nodes) {
            x *= scale;
        }
        CHECK(check(scaled).count(SurfaceFault::intersection) == report.count(SurfaceFault::intersection));
    }
}

TEST_CASE("A surface that folds through itself names the triangles") {
    TaggedSurface s = tets::box();
    s.mesh.nodes[7] = {-2.0, 0.4, 0.4};
    const SurfaceReport report = check(s);
    REQUIRE(report.count(SurfaceFault::intersection) > 0);
    for (const Item& item : report.find(SurfaceFault::intersection)->items) {
        const auto has = [&](std::size_t i) {
            const TriCorners& c = s.mesh.triangles[item.triangles[i]];
            return std::find(c.begin(), c.end(), 7) != c.end();
        };
        CHECK((has(0) || has(1)));
    }
}

TEST_CASE("Neighbours that overlap in one plane") {
    // A flat fan round node 0 whose last triangle lies on the first: they share an edge and the plane.
    TaggedSurface s;
    s.mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}};
    s.mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const SurfaceReport report = check(s);
    REQUIRE(report.find(SurfaceFault::intersection) != nullptr);
    CHECK(report.find(SurfaceFault::intersection)->items == std::vector<Item>{{{0, 1}, {}}});
}

TEST_CASE("Shells turned inside out") {
    const TaggedSurface outer = tets::box(Vec3::Constant(-4), Vec3::Constant(4));
    const TaggedSurface inner = tets::box();
    CHECK(check(tets::joined(outer, inner, true)).ok());
    check_only(check(tets::joined(outer, inner)), SurfaceFault::inside_out, 1, {{{12}, {}}});
    TaggedSurface turned = inner;
    for (TriCorners& c : turned.mesh.triangles) {
        std::swap(c[0], c[1]);
    }
    check_only(check(turned), SurfaceFault::inside_out, 1, {{{0}, {}}});
    // Far thinner than wide, and turned in space: still told apart.
    for (const bool inwards : {false, true}) {
        TaggedSurface plate = tets::box(Vec3::Zero(), Vec3(1, 1, 1e-12));
        if (inwards) {
            for (TriCorners& c : plate.mesh.triangles) {
                std::swap(c[0], c[1]);
            }
        }
        CHECK(check(tets::turned(plate, 1)).count(SurfaceFault::inside_out) == (inwards ? 1U : 0U));
    }
}

TEST_CASE("Counts are exact, items are limited") {
    TaggedSurface s;
    for (Index i = 0; i < 40; ++i) {
        const double x = i;
        s.mesh.nodes.insert(s.mesh.nodes.end(), {Vec3(x, 0, 0), Vec3(x + 0.5, 0, 0), Vec3(x, 1, 0)});
        s.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const SurfaceReport report = check(s);
    CHECK(report.count(SurfaceFault::open_edge) == 120);
    CHECK(report.find(SurfaceFault::open_edge)->items.size() == 16);
    CHECK(report.text().substr(0, 43) == "120 edges where the surface is open: nodes ");
    CHECK(report.text().substr(report.text().size() - 4) == " ...");
}

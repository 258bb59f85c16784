#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/detail/faceted_field.hpp>
#include <pavior/marking/field.hpp>
#include <pavior/marking/fit_surface.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace pavior;

TEST_CASE("the field of a front is zero on its curve and on the material side of its patch") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const ReferenceMesh mesh = tet_meshes::reference(solid, 2, false);
    const TetTopology topology = tet_topology(mesh);
    const FrontBoundary boundary = front_boundary(mesh, topology);
    const std::vector<Front> fronts = sheet_fronts(mesh, topology, boundary, 1e-6);
    const std::vector<SheetGroup> groups = sheet_groups(fronts, boundary, mesh.nodes, Grouping::exact, 1e-6, 30.0);
    REQUIRE(groups.size() == 2);
    for (const SheetGroup& group : groups) {
        const SheetCut sheet = sheet_field(mesh, group, fronts, boundary, 1e-6);
        REQUIRE(sheet.values.size() == mesh.nodes.size());
        CHECK_FALSE(sheet.curved);
        CHECK(sheet.start_edges.size() == 2);
        const Vec3 normal = group.members[0].surface.normal(Vec3(0, 0, 0));
        std::size_t zero = 0;
        for (const Index i : IndexRange(mesh.nodes.size())) {
            const Vec3& x = mesh.nodes[i];
            const double plane = group.members[0].sign * normal.dot(x - Vec3(1, 1, 0));
            zero += sheet.values[i] == 0 ? 1 : 0;
            if (std::abs(plane) > 1e-3) {
                CHECK(sheet.values[i] * plane > 0);
            }
            const bool patch = std::abs(plane) < 1e-9 && (x[0] > 1 || x[1] > 1);
            CHECK((patch ? sheet.values[i] < 0 || sheet.fixed[i] != 0 : true));
            if (x[0] == 1 && x[1] == 1) {
                CHECK(sheet.values[i] == 0);
            }
        }
        CHECK(zero >= 9);
    }
}

TEST_CASE("the nearest triangle of a tree is that of a search through all") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-1, 1);
    const auto point = [&] { return Vec3(at(random), at(random), at(random)); };
    std::vector<std::array<Vec3, 3>> triangles;
    for (int i = 0; i < 77; ++i) {
        const Vec3 x = 3 * point();
        triangles.push_back({x, x + point(), x + point()});
    }
    const detail::NearTriangles tree(triangles);
    for (int i = 0; i < 200; ++i) {
        const Vec3 x = 4 * point();
        double least = std::numeric_limits<double>::infinity();
        for (const auto& t : triangles) {
            least = std::min(least, detail::squared_distance_to_triangle(x, t));
        }
        CHECK(tree.nearest(x).square == Approx(least).epsilon(1e-12));
        CHECK(tree.nearest(x, 0.5 * least).square == 0.5 * least);
    }
    CHECK(detail::NearTriangles().nearest(Vec3(0, 0, 0), 2.0).square == 2.0);
}

TEST_CASE("a faceted cylinder keeps the material of its chords on one side, and is round away from them") {
    detail::FacetedField field;
    field.surface.kind = SurfaceKind::cylinder;
    field.surface.radius = 1;
    field.surface.sense = -1;  // a hole: material outside
    std::vector<std::array<Vec3, 3>> triangles;
    const auto corner = [](int k, double z) {
        return Vec3(std::cos(k * 0.5235987755982988), std::sin(k * 0.5235987755982988), z);
    };
    for (int k = 0; k < 12; ++k) {
        triangles.push_back({corner(k, 0), corner(k, 1), corner(k + 1, 1)});
        triangles.push_back({corner(k, 0), corner(k + 1, 1), corner(k + 1, 0)});
    }
    field.surface.sagitta = 1 - std::cos(0.2617993877991494);
    field.triangles = detail::NearTriangles(triangles);
    const Vec3 chord = 0.5 * (corner(0, 0.5) + corner(1, 0.5));
    CHECK(field(1.01 * chord) < 0);  // behind the facet, though within the cylinder
    CHECK(field(0.99 * chord) > 0);
    CHECK(field(Vec3(chord[0], chord[1], -1)) > 0);  // the true cylinder further down
    CHECK(field(Vec3(1, 0, -1)) == Approx(0).margin(1e-12));
}

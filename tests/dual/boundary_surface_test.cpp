#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/boundary_surface.hpp>

#include <algorithm>

using namespace pavior;

TEST_CASE("the boundary of a box: outward, closed, right angles") {
    const TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(2, 3, 1)).mesh;
    const TetTopology topology = tet_topology(mesh);
    const BoundarySurface surface = boundary_surface(mesh, topology);
    CHECK(surface.triangles.size() == 2 * 2 * (6 + 2 + 3));
    CHECK(surface.edges.size() == surface.triangles.size() * 3 / 2);
    double volume = 0.0;
    for (const TriCorners& c : surface.triangles) {
        volume += mesh.nodes[c[0]].dot(mesh.nodes[c[1]].cross(mesh.nodes[c[2]])) / 6.0;
    }
    CHECK(volume == Approx(6.0));
    const std::vector<double> angles = interior_angles(mesh, topology, surface);
    CHECK(std::count_if(angles.begin(), angles.end(), [](double a) { return std::abs(a - 90) < 1e-9; }) == 24);
    CHECK(std::count_if(angles.begin(), angles.end(), [](double a) { return std::abs(a - 180) < 1e-9; }) ==
          static_cast<std::ptrdiff_t>(angles.size()) - 24);
    for (std::size_t s = 0; s < surface.edges.size(); ++s) {
        for (const Index b : surface.edge_triangles[s]) {
            const auto& e = surface.triangle_edges[b];
            CHECK(std::count(e.begin(), e.end(), s) == 1);
        }
    }
}

TEST_CASE("re-entrant angles") {
    const auto l_shape = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const TetMesh mesh = tet_meshes::tetrahedra(l_shape).mesh;
    const TetTopology topology = tet_topology(mesh);
    const BoundarySurface surface = boundary_surface(mesh, topology);
    const std::vector<double> angles =
        interior_angles(archetype::Tets({mesh.nodes, mesh.tets, {}, {}, {}, {}, {}, {}}), topology, surface);
    CHECK(*std::max_element(angles.begin(), angles.end()) == Approx(270.0));
    CHECK(std::count_if(angles.begin(), angles.end(), [](double a) { return a > 225.0; }) == 1);
}

TEST_CASE("a slit has 360 degrees at its end, a notch nearly so") {
    // Two boxes on each side of a wall, one pair of them joined: pull the wall's two sides together.
    const auto u_shape = tet_meshes::voxels({3, 2, 1}, [](Index i, Index j, Index) { return i != 1 || j == 0; });
    TetMesh mesh = tet_meshes::tetrahedra(u_shape).mesh;
    const auto squeeze = [&](double gap) {
        TetMesh squeezed = mesh;
        for (Vec3& x : squeezed.nodes) {
            if (x.y() > 1.5) {
                x.x() = x.x() <= 1.0 ? x.x() * (1.5 - gap) : 3.0 - (3.0 - x.x()) * (1.5 - gap);
            } else if (x.y() > 0.5) {
                x.x() = x.x() == 1.0 ? 1.5 - 1e-3 * gap : x.x() == 2.0 ? 1.5 + 1e-3 * gap : x.x();
            }
        }
        const TetTopology topology = tet_topology(squeezed);
        const BoundarySurface surface = boundary_surface(squeezed, topology);
        const std::vector<double> angles = interior_angles(squeezed, topology, surface);
        return *std::max_element(angles.begin(), angles.end());
    };
    CHECK(squeeze(0.1) > 262.0);
    CHECK(squeeze(0.1) < 360.0);
}

TEST_CASE("coincident triangles that are neighbours") {
    // Six tetrahedra round an axis, all but closed: the first and the last side coincide.
    TetMesh mesh{{Vec3(0, 0, 0), Vec3(0, 0, 1)}, {}};
    for (int i = 0; i <= 6; ++i) {
        const double a = i == 6 ? 0.0 : i * 3.14159265358979323846 / 3.0;
        mesh.nodes.push_back(Vec3(std::cos(a), std::sin(a), 0.5));
    }
    for (Index i = 0; i < 6; ++i) {
        mesh.tets.push_back({0, 2 + i, 3 + i, 1});
    }
    const TetTopology topology = tet_topology(mesh);
    const BoundarySurface surface = boundary_surface(mesh, topology);
    const std::vector<double> angles = interior_angles(mesh, topology, surface);
    const Index axis = topology.edge(0, 1);
    for (std::size_t s = 0; s < surface.edges.size(); ++s) {
        if (surface.edges[s] == axis) {
            CHECK(angles[s] == 360.0);
        }
    }
}

TEST_CASE("boundaries that touch themselves") {
    const auto thrown = [](const TetMesh& mesh) {
        try {
            std::ignore = boundary_surface(mesh, tet_topology(mesh));
        } catch (const InputError& error) {
            CHECK(error.code() == ErrorCode::non_manifold);
            return error.ids().size();
        }
        return std::size_t{0};
    };
    const auto diagonal = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == j; });
    CHECK(thrown(tet_meshes::tetrahedra(diagonal).mesh) == 2);
    const auto corner = tet_meshes::voxels({2, 2, 2}, [](Index i, Index j, Index k) { return i == j && j == k; });
    CHECK(thrown(tet_meshes::tetrahedra(corner).mesh) == 1);
    CHECK(thrown(tet_meshes::tetrahedra(tet_meshes::box(2, 1, 1)).mesh) == 0);
}

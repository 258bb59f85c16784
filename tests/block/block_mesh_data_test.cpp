#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/detail/tag_finder.hpp>

#include <random>
#include <set>

using namespace pavior;

TEST_CASE("The tag of a place on a patch is that of the nearest of its triangles, as a search through all finds it") {
    TaggedSurface surface;  // a strip of squares along x, tags 1, 2, 3 in turn, with a fourth far off
    for (int i = 0; i <= 12; ++i) {
        surface.mesh.nodes.emplace_back(i, 0, 0.1 * (i % 3));
        surface.mesh.nodes.emplace_back(i, 1, 0);
    }
    for (Index i = 0; i < 12; ++i) {
        surface.mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        surface.mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
        surface.face_tags.insert(surface.face_tags.end(), 2, static_cast<std::int32_t>(1 + i % 4));
    }
    ReferenceMesh reference;
    reference.patch_tags = {{0, 1}, {0, 2}, {0, 3}, {1, 4}, {2, 0}};
    detail::TagFinder finder(reference, surface);
    CHECK(finder.tag(1, {50, 50, 50}) == 4);
    CHECK(finder.tag(2, {0, 0, 0}) == 0);
    CHECK(finder.tag(7, {0, 0, 0}) == 0);
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> place(-2, 14);
    for (int round = 0; round < 300; ++round) {
        const Vec3 x(place(dice), 0.2 * place(dice), 0.2 * place(dice));
        double best = HUGE_VAL;
        std::int32_t expected = 0;
        for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
            const auto& c = surface.mesh.triangles[t];
            const auto& n = surface.mesh.nodes;
            const Eigen::Vector3d w = detail::nearest_weights(x, n[c[0]], n[c[1]], n[c[2]]);
            const double d = (w[0] * n[c[0]] + w[1] * n[c[1]] + w[2] * n[c[2]] - x).squaredNorm();
            if (surface.face_tags[t] != 4 && d < best) {
                best = d;
                expected = surface.face_tags[t];
            }
        }
        CHECK(finder.tag(0, x) == expected);
    }
}

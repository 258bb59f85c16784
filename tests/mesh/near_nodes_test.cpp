#include "support/catch.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/near_nodes.hpp>

#include <limits>
#include <random>

using namespace pavior;
using Pairs = std::vector<std::array<Index, 2>>;

TEST_CASE("bounds") {
    const Box<Vec3> box = bounds(shapes::hex_box(2, 2, 2, Vec3(1, 2, 2)));
    CHECK(box.low == Vec3(0, 0, 0));
    CHECK(box.high == Vec3(1, 2, 2));
    CHECK(box.diagonal() == 3.0);
    CHECK(box.centre() == Vec3(0.5, 1, 1));
    CHECK(bounds(std::vector<Vec3>{}).diagonal() == 0.0);
}

TEST_CASE("grids have no near nodes; each copy is found once") {
    std::vector<Vec3> nodes = shapes::hex_box(8, 8, 8).nodes;
    CHECK(near_nodes(nodes, 1e-9).empty());
    nodes.push_back(nodes[5] + Vec3(0, 1e-10, 0));
    nodes.push_back(nodes[7]);
    nodes.push_back(nodes[7]);
    CHECK(near_nodes(nodes, 1e-9) == Pairs{{729, 5}, {730, 7}, {731, 7}});
    CHECK(near_nodes(nodes, 0.0) == Pairs{{730, 7}, {731, 7}});
}

TEST_CASE("the same pairs as by comparing all with all, across the borders of cells") {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double distance : {0.01, 0.03, 0.1}) {
        std::vector<Vec3> nodes;
        for (int i = 0; i < 1500; ++i) {
            nodes.emplace_back(unit(generator), unit(generator), unit(generator));
        }
        Pairs wanted;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if ((nodes[i] - nodes[j]).norm() <= distance) {
                    wanted.push_back({static_cast<Index>(i), static_cast<Index>(j)});
                    break;
                }
            }
        }
        const Pairs found = near_nodes(nodes, distance);
        REQUIRE(found.size() == wanted.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
            CHECK(found[k][0] == wanted[k][0]);
            CHECK((nodes[found[k][0]] - nodes[found[k][1]]).norm() <= distance);
        }
    }
}

TEST_CASE("all in one place, not finite, huge and tiny") {
    const std::vector<Vec3> same(1000, Vec3(1, 2, 3));
    CHECK(near_nodes(same, 0.0).size() == 999);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(near_nodes(std::vector<Vec3>{Vec3(nan, 0, 0), Vec3(nan, 0, 0)}, 1.0).empty());
    for (const double scale : {1e-200, 1e200}) {
        std::vector<Vec3> nodes{scale * Vec3(0, 0, 0), scale * Vec3(1, 0, 0), scale * Vec3(1, 1e-12, 0)};
        CHECK(near_nodes(nodes, 1e-9 * scale) == Pairs{{2, 1}});
    }
    // One far node makes all others fall into few cells; they are still apart.
    std::vector<Vec3> far = shapes::hex_box(6, 6, 6).nodes;
    far.emplace_back(1e7, 0, 0);
    CHECK(near_nodes(far, 1e-9 * 1e7).empty());
    CHECK(near_nodes(far, 0.17).size() == 342);
}

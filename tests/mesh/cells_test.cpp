#include "support/catch.hpp"

#include <pavior/math/hexahedron.hpp>
#include <pavior/mesh/cells.hpp>

#include <map>
#include <utility>

using namespace pavior;

namespace {
const HexPoints cube{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                     Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
Vec3 corner(int i) { return cube[static_cast<std::size_t>(i)]; }
}  // namespace

TEST_CASE("the six quads of a hexahedron look outwards and cover each edge once each way") {
    std::map<std::pair<int, int>, int> edges;
    for (const auto& f : hex_faces) {
        const Vec3 normal = (corner(f[1]) - corner(f[0])).cross(corner(f[3]) - corner(f[0]));
        const Vec3 centre = (corner(f[0]) + corner(f[2])) / 2.0;
        CHECK(normal.dot(centre - Vec3(0.5, 0.5, 0.5)) == 0.5);
        for (std::size_t k = 0; k < 4; ++k) {
            ++edges[{f[k], f[(k + 1) % 4]}];
        }
    }
    CHECK(edges.size() == 24);
    for (const auto& [edge, uses] : edges) {
        CHECK(uses == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
}

TEST_CASE("the three neighbours of each corner make a positive frame") {
    for (std::size_t c = 0; c < 8; ++c) {
        const auto& n = hex_corner_neighbours[c];
        const Vec3 x = cube[c];
        CHECK((corner(n[0]) - x).dot((corner(n[1]) - x).cross(corner(n[2]) - x)) == 1.0);
    }
}

TEST_CASE("loops are slices of one list") {
    Loops loops;
    CHECK(loops.size() == 0);
    loops.add(std::array<Index, 3>{4, 5, 6});
    loops.add(std::array<Index, 2>{9, 8});
    CHECK(loops.size() == 2);
    CHECK(std::vector<Index>(loops[0].begin(), loops[0].end()) == std::vector<Index>{4, 5, 6});
    CHECK(std::vector<Index>(loops[1].begin(), loops[1].end()) == std::vector<Index>{9, 8});
    CHECK(loops.offsets == std::vector<std::size_t>{0, 3, 5});
    Loops other = loops;
    CHECK(other == loops);
    other.add(std::array<Index, 1>{1});
    CHECK_FALSE(other == loops);
}

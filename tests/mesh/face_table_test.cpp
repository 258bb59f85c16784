#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/face_table.hpp>

#include <array>
#include <vector>

using namespace pavior;

namespace {
template <hex_mesh M>
std::vector<std::size_t> uses(const M& mesh, std::span<const char> skip = {}) {
    std::vector<std::size_t> counts(4, 0);
    const FaceTable table(mesh, skip);
    table.for_each(mesh, 0, table.node_count(),
                   [&](Index, std::span<const FaceTable::Use> faces) { ++counts[faces.size()]; });
    return counts;
}
}  // namespace

TEST_CASE("two hexahedra have eleven quads, one of them shared") {
    const HexMesh mesh = shapes::hex_box(2, 1, 1);
    CHECK(uses(mesh) == std::vector<std::size_t>{0, 10, 1, 0});
    CHECK(uses(archetype::Hexes(mesh)) == std::vector<std::size_t>{0, 10, 1, 0});
    CHECK(uses(mesh, std::vector<char>{0, 1}) == std::vector<std::size_t>{0, 6, 0, 0});
    const FaceTable table(mesh);
    table.for_each(mesh, 1, 2, [&](Index low, std::span<const FaceTable::Use> faces) {
        if (faces.size() == 2) {
            CHECK(low == 1);
            CHECK(faces[0].others == std::array<Index, 3>{4, 7, 10});
            CHECK(faces[0].hex() == 0);
            CHECK(faces[0].local() == 3);
            CHECK(faces[1].hex() == 1);
            CHECK(faces[1].local() == 5);
        }
    });
}

TEST_CASE("a box of a b c hexahedra has 3 a b c + a b + b c + c a quads") {
    const std::vector<std::size_t> counts = uses(shapes::hex_box(3, 4, 5));
    CHECK(counts[1] == 2 * (12 + 20 + 15));
    CHECK(counts[1] + counts[2] == 3 * 60 + 12 + 20 + 15);
}

TEST_CASE("quads of a hexahedron, their start and their other side") {
    const HexCorners corners{10, 11, 12, 13, 14, 15, 16, 17};
    CHECK(hex_face(corners, 0) == QuadCorners{10, 13, 12, 11});
    CHECK(hex_face(corners, 5) == QuadCorners{13, 10, 14, 17});
    CHECK(from_smallest({13, 10, 14, 17}) == QuadCorners{10, 14, 17, 13});
    CHECK(opposite({1, 2, 3, 4}, {3, 2, 1, 4}));
    CHECK_FALSE(opposite({1, 2, 3, 4}, {2, 3, 4, 1}));
    CHECK_FALSE(opposite({1, 2, 3, 4}, {1, 2, 4, 3}));
}

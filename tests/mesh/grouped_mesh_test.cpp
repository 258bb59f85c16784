#include "support/catch.hpp"

#include <pavior/mesh/grouped_mesh.hpp>

using namespace pavior;

TEST_CASE("Names of groups belong to a number of one dimension") {
    HexMeshData data;
    data.groups = {{3, 1, "block"}, {2, 1, "wall"}, {2, 4, ""}};
    CHECK(group_name(data, 3, 1) == "block");
    CHECK(group_name(data, 2, 1) == "wall");
    CHECK(group_name(data, 2, 4).empty());
    CHECK(group_name(data, 3, 4).empty());
}

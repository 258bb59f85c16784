#include <pavior/part/cad_deviation.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/mesh/grouped_mesh.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

struct Measured : TestBrep {
    [[nodiscard]] double solid_volume(SolidId) const { return 6; }
};

/// One hexahedron in the prism 3 x 2 x 1 and its quads; `raised` is added to the top.
HexMeshData box(double raised) {
    HexMeshData data;
    for (const double z : {0.0, 1 + raised}) {
        for (const auto& [x, y] : {std::pair{0, 0}, std::pair{3, 0}, std::pair{3, 2}, std::pair{0, 2}}) {
            data.mesh.nodes.emplace_back(x, y, z);
        }
    }
    data.mesh.hexes.push_back({0, 1, 2, 3, 4, 5, 6, 7});
    data.quads = {{0, 3, 2, 1}, {4, 5, 6, 7}};
    return data;
}

}  // namespace

TEST_CASE("Distance and volume are told in parts of what they are measured by") {
    Measured b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(3, 2), 0, 1)};
    const auto faces = b.solid_faces(solids[0]);
    const std::vector<FaceId> caps{faces[0].face, faces[1].face};
    const HexMeshData data = box(0.25);
    const CadDeviation deviation = cad_deviation(b, solids, data.mesh.nodes, data.quads, caps, 7.5, 0.5);
    CHECK(deviation.cad_volume == 6.0);
    CHECK(deviation.relative_volume().value() == Approx(0.25));
    CHECK(deviation.distance.value() == Approx(0.25));
    CHECK(deviation.distance_in_sizes().value() == Approx(0.5));
    const std::vector<std::string> warnings = warnings_of(deviation);
    REQUIRE(warnings.size() == 2);
    CHECK_THAT(warnings[0], Catch::Contains("25 % more volume"));
    CHECK_THAT(warnings[1], Catch::Contains("0.5 of the size"));
    CHECK(text_of(deviation) == "volume +25 % off the geometry, boundary within 0.5 sizes of it");
    const HexMeshData exact = box(0);
    const CadDeviation none = cad_deviation(b, solids, exact.mesh.nodes, exact.quads, caps, 6, 0.5);
    CHECK(warnings_of(none).empty());
    CHECK(text_of(none) == "volume 0 % off the geometry, boundary within 0 sizes of it");
    const CadDeviation both = deviation + none;
    CHECK(both.volume == 13.5);
    CHECK(both.cad_volume == 12.0);
    CHECK(both.distance == deviation.distance);
}

TEST_CASE("What is not known stays unknown: no time, no volumes, no faces") {
    Measured b;
    const std::vector<SolidId> solids{add_cylinder(b, 1, 1, 2)};
    const HexMeshData data = box(0);
    const std::vector<FaceId> wall(2, b.solid_faces(solids[0])[2].face);
    const auto& x = data.mesh.nodes;
    const CadDeviation late = cad_deviation(b, solids, x, data.quads, wall, 6, 0.5, [] { return true; });
    CHECK_FALSE(late.distance.has_value());
    CHECK_FALSE(late.distance_in_sizes().has_value());
    CHECK(text_of(late) == "volume 0 % off the geometry");
    CHECK(cad_deviation(b, solids, x, data.quads, wall, 6, 0.5, [] { return false; }).distance.has_value());
    TestBrep plain;
    const std::vector<SolidId> unknown{add_prism(plain, rectangle(3, 2), 0, 1)};
    const CadDeviation nothing = cad_deviation(plain, unknown, x, data.quads, {}, 6, 0);
    CHECK_FALSE(nothing.relative_volume().has_value());
    CHECK_FALSE(nothing.distance.has_value());
    CHECK(text_of(nothing).empty());
    CHECK_FALSE((nothing + late).cad_volume.has_value());
}

TEST_CASE("A mesh lacks a part where its volume is off by more than its angle a mesh edge can cost") {
    CadDeviation deviation;
    CHECK_FALSE(lacks_a_part(deviation, 30));  // nothing is known
    deviation.cad_volume = 100;
    for (const auto& [volume, lacks] : {std::pair(95.0, false), {91.0, false}, {73.0, true}, {127.0, true}}) {
        deviation.volume = volume;
        CHECK(lacks_a_part(deviation, 30) == lacks);
    }
    deviation.volume = 91;
    CHECK(lacks_a_part(deviation, 10));
    deviation.volume = 98.5;
    CHECK_FALSE(lacks_a_part(deviation, 1));
}

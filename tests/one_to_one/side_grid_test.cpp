#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/mesh_linking_side.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/side_grid.hpp>

#include <set>

using namespace pavior;

namespace {

struct Meshed {
    test::TestBrep b;
    SweepTopology sweep;
    std::vector<int> intervals;
    BoundaryMesh mesh;

    explicit Meshed(int storeys) {
        const SolidId solid = test::add_prism(b, test::l_shape(), 0, 1, {}, storeys);
        sweep = sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face);
        intervals.assign(b.edge_count(), 2);
        mesh = mesh_edges(b, intervals);
        for (const LinkingSide& side : sweep.loops[0]) {
            mesh_linking_side(b, mesh, side, true);
        }
    }
};

}  // namespace

TEST_CASE("levels go up the linking sides, one above the other") {
    for (const int storeys : {1, 2}) {
        CAPTURE(storeys);
        const Meshed m(storeys);
        const LevelIds levels = level_ids(m.b, m.mesh, m.sweep, m.intervals);
        CHECK(levels.layers == static_cast<std::size_t>(2 * storeys));
        CHECK(levels.level_size() == 12);
        std::set<Index> all(levels.ids.begin(), levels.ids.end());
        CHECK(all.size() == levels.ids.size());
        for (std::size_t k = 0; k <= levels.layers; ++k) {
            for (std::size_t i = 0; i < 12; ++i) {
                const Vec3& low = m.mesh.nodes[levels.level(0)[i]];
                const Vec3& x = m.mesh.nodes[levels.level(k)[i]];
                CHECK((x - low - Vec3(0, 0, static_cast<double>(k) / static_cast<double>(levels.layers))).norm() <
                      1e-14);
            }
        }
    }
}

TEST_CASE("a side can be read from all ways to look at it") {
    Meshed m(1);
    const LinkingSide& side = m.sweep.loops[0][0];
    const std::vector<Index> ids = side_ids(m.b, m.mesh, side);
    REQUIRE(ids.size() == 9);
    const LinkingSide upside_down{side.face,           side.outward,          reversed(side.top),
                                  reversed(side.left), reversed(side.bottom), reversed(side.right)};
    const std::vector<Index> back = side_ids(m.b, m.mesh, upside_down);
    CHECK(std::vector<Index>(ids.rbegin(), ids.rend()) == back);
    const LinkingSide lying{side.face, side.outward, side.left, side.top, side.right, side.bottom};
    const std::vector<Index> transposed = side_ids(m.b, m.mesh, lying);
    CHECK(transposed[1] == ids[3]);
    CHECK(transposed[3] == ids[1]);
}

TEST_CASE("a face that another solid has meshed otherwise is refused by name") {
    Meshed m(1);
    const LinkingSide& side = m.sweep.loops[0][0];
    m.mesh.faces[side.face.index()].columns = 0;
    try {
        (void)side_ids(m.b, m.mesh, side);
        FAIL("accepted");
    } catch (const UnmeshableError& error) {
        CHECK(error.code() == ErrorCode::not_sweepable);
        CHECK(error.ids() == Error::Ids{side.face.value + 1});
    }
}

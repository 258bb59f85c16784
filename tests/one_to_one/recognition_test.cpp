#include <pavior/one_to_one/recognition.hpp>

#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <string>

using namespace pavior;
using namespace pavior::test;

static_assert(brep<TestBrep>);

namespace {

/// Everything that SweepTopology promises, checked against the model.
void verify(const TestBrep& b, const SweepTopology& sweep) {
    const auto chain_ok = [&](const EdgeChain& chain) {
        REQUIRE(!chain.empty());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            CHECK(last_vertex(b, chain[i]) == first_vertex(b, chain[i + 1]));
        }
    };
    std::size_t faces = 2;
    REQUIRE(sweep.source_loops.size() == sweep.loops.size());
    REQUIRE(sweep.target_loops.size() == sweep.loops.size());
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        const auto& sides = sweep.loops[i];
        faces += sides.size();
        EdgeLoop bottoms, tops;
        for (std::size_t j = 0; j < sides.size(); ++j) {
            const LinkingSide& s = sides[j];
            for (const EdgeChain* chain : {&s.bottom, &s.right, &s.top, &s.left}) {
                chain_ok(*chain);
            }
            CHECK(first_vertex(b, s.bottom.front()) == first_vertex(b, s.left.front()));
            CHECK(last_vertex(b, s.bottom.back()) == first_vertex(b, s.right.front()));
            CHECK(last_vertex(b, s.left.back()) == first_vertex(b, s.top.front()));
            CHECK(last_vertex(b, s.right.back()) == last_vertex(b, s.top.back()));
            bottoms.insert(bottoms.end(), s.bottom.begin(), s.bottom.end());
            tops.insert(tops.end(), s.top.begin(), s.top.end());
            if (!sweep.stacked) {
                CHECK(s.right == sides[(j + 1) % sides.size()].left);
            }
        }
        chain_ok(sweep.source_loops[i]);
        chain_ok(sweep.target_loops[i]);
        CHECK(last_vertex(b, sweep.source_loops[i].back()) == first_vertex(b, sweep.source_loops[i].front()));
        if (!sweep.stacked) {
            CHECK(bottoms == sweep.source_loops[i]);
            CHECK(tops == sweep.target_loops[i]);
        }
    }
    CHECK(faces == b.solid_faces(sweep.solid).size());
}

/// Twice the signed area of a loop of straight edges seen from the tip of z.
double signed_area(const TestBrep& b, const EdgeLoop& loop) {
    double sum = 0.0;
    for (const OrientedEdge& use : loop) {
        const Vec3 p = b.vertex_point(first_vertex(b, use)), q = b.vertex_point(last_vertex(b, use));
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("A box can be swept along each of its axes") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(2, 3), 0, 4);
    const Recognition r = recognise_sweeps(b, box);
    REQUIRE(r.candidates.size() == 3);
    CHECK(r.sweepable());
    CHECK(r.refusals.empty());
    for (const SweepTopology& sweep : r.candidates) {
        verify(b, sweep);
        CHECK(sweep.source < sweep.target);
        CHECK_FALSE(sweep.stacked);
        CHECK(sweep.shape.corner_deviation < 1e-9);
        CHECK(sweep.shape.rib_ratio == Approx(1));
    }
    CHECK(r.candidates[0].source == FaceId{0});
    CHECK(r.candidates[0].target == FaceId{1});
}

TEST_CASE("A prism with holes is swept between its caps only, loops as seen from the tip of the sweep") {
    TestBrep b;
    const Polygon hole{{0.2, 0.2}, {0.2, 0.6}, {0.6, 0.6}, {0.6, 0.2}}, slit{{1.2, 0.2}, {1.4, 0.7}, {1.6, 0.2}};
    const SolidId solid = add_prism(b, l_shape(), 0, 1, {hole, slit});
    const Recognition r = recognise_sweeps(b, solid);
    REQUIRE(r.candidates.size() == 1);
    const SweepTopology& sweep = r.candidates[0];
    verify(b, sweep);
    CHECK(sweep.source == FaceId{0});
    CHECK_FALSE(sweep.source_outward);
    CHECK(sweep.target_outward);
    REQUIRE(sweep.loops.size() == 3);
    CHECK(sweep.loops[0].size() == 6);
    CHECK(sweep.loops[1].size() == 4);
    CHECK(sweep.loops[2].size() == 3);
    const double areas[] = {6.0, -0.32, -0.2};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(signed_area(b, sweep.source_loops[i]) == Approx(areas[i]));
        CHECK(signed_area(b, sweep.target_loops[i]) == Approx(areas[i]));
        for (const LinkingSide& side : sweep.loops[i]) {
            const Vec3 rib =
                b.vertex_point(last_vertex(b, side.left.back())) - b.vertex_point(first_vertex(b, side.left.front()));
            CHECK((rib - Vec3(0, 0, 1)).norm() < 1e-12);
        }
    }
    CHECK(sweep.shape.cap_loops == 3);
    CHECK(sweep.shape.cap_edges == 26);

    const SweepTopology down = sweep_between(b, solid, FaceId{1}, FaceId{0});
    verify(b, down);
    CHECK(down.source == FaceId{1});
    CHECK(down.source_outward);
    CHECK(signed_area(b, down.source_loops[0]) == Approx(-6.0));
}

TEST_CASE("Round walls are linking sides whose right and left are the seam") {
    TestBrep b;
    const SolidId bar = add_cylinder(b, 1, 1, 3), pipe = add_cylinder(b, 2, 1.5, 3, 0.5);
    const Recognition r = recognise_sweeps(b, bar);
    REQUIRE(r.candidates.size() == 1);
    verify(b, r.candidates[0]);
    const LinkingSide& wall = r.candidates[0].loops[0][0];
    CHECK(wall.closed());
    CHECK(wall.bottom.size() == 1);
    CHECK(wall.left.size() == 1);
    CHECK(r.candidates[0].shape.corner_deviation < 1e-6);

    const Recognition p = recognise_sweeps(b, pipe);
    REQUIRE(p.candidates.size() == 1);
    verify(b, p.candidates[0]);
    CHECK(p.candidates[0].loops.size() == 2);
    CHECK_FALSE(p.candidates[0].loops[1][0].outward);
    CHECK(p.candidates[0].shape.corner_deviation < 1e-6);
    CHECK(p.candidates[0].shape.rib_ratio == Approx(std::hypot(3, 0.5) / 3));
    CHECK_THROWS_WITH(sweep_between(b, pipe, FaceId{4}, FaceId{5}), Catch::Contains("seam"));
}

TEST_CASE("A logical side may be several edges") {
    TestBrep b;  // the bottom edge y = 0 and the rib at the origin have a vertex in the middle
    const auto low = lift(b, {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 0), high = lift(b, rectangle(2, 2), 2);
    const VertexId mid = b.vertex({0, 0, 1});
    const SolidId solid = b.solid({{b.flat_polygon(low), false},
                                   {b.flat_polygon(high), true},
                                   {b.flat_polygon({low[0], low[1], low[2], high[1], high[0], mid}), true},
                                   {b.flat_polygon({low[2], low[3], high[2], high[1]}), true},
                                   {b.flat_polygon({low[3], low[4], high[3], high[2]}), true},
                                   {b.flat_polygon({low[4], low[0], mid, high[0], high[3]}), true}});
    const SweepTopology sweep = sweep_between(b, solid, FaceId{0}, FaceId{1});
    verify(b, sweep);
    CHECK_FALSE(sweep.stacked);
    const LinkingSide* front = nullptr;
    for (const LinkingSide& side : sweep.loops[0]) {
        front = side.face == FaceId{2} ? &side : front;
    }
    REQUIRE(front != nullptr);
    CHECK(front->bottom.size() == 2);
    CHECK(front->top.size() == 1);
    CHECK(front->left.size() == 2);
    CHECK(front->right.size() == 1);
    for (const SweepTopology& other : recognise_sweeps(b, solid).candidates) {
        verify(b, other);
    }
}

TEST_CASE("Sides above each other are found and placed") {
    TestBrep b;
    const SolidId tower = add_prism(b, l_shape(), 0, 3, {}, 3);
    const Recognition r = recognise_sweeps(b, tower);
    REQUIRE(r.candidates.size() == 1);
    const SweepTopology& sweep = r.candidates[0];
    verify(b, sweep);
    CHECK(sweep.stacked);
    CHECK(sweep.loops[0].size() == 18);
    CHECK(sweep.shape.rib_ratio == Approx(1));

    RecognitionOptions flat;
    flat.stacked = false;
    const Recognition refused = recognise_sweeps(b, tower, flat);
    CHECK(refused.candidates.empty());
    REQUIRE(!refused.refusals.empty());
}

TEST_CASE("A side may reach over two storeys of its neighbour") {
    TestBrep b;
    const SolidId solid = add_half_stacked_box(b);
    const SweepTopology sweep = sweep_between(b, solid, FaceId{0}, FaceId{1});
    verify(b, sweep);
    CHECK(sweep.stacked);
    REQUIRE(sweep.loops[0].size() == 6);
    std::vector<int> intervals(b.edge_count(), 2);
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        const auto ends = b.edge_vertices({static_cast<std::int32_t>(e)});
        const double rise = std::abs(b.vertex_point(ends[1])[2] - b.vertex_point(ends[0])[2]);
        intervals[e] = rise > 0.9 ? 5 : rise > 0.5 ? 3 : 2;
    }
    const auto placed = place_sides(sweep, intervals);
    std::size_t raised = 0;
    for (std::size_t j = 0; j < 6; ++j) {
        const LinkingSide& side = sweep.loops[0][j];
        const Vec3 corner = b.vertex_point(first_vertex(b, side.bottom.front()));
        CHECK(placed[0][j].row == (corner[2] > 0.1 ? 2 : 0));
        raised += placed[0][j].row == 2 ? 1 : 0;
        CHECK(placed[0][j].columns == 2);
    }
    CHECK(raised == 2);
}

TEST_CASE("The prism over a hexagon is swept between its hexagons, not through them") {
    TestBrep b;
    Polygon hexagon;
    for (int i = 0; i < 6; ++i) {
        hexagon.emplace_back(std::cos(i * 1.0471975511965976), std::sin(i * 1.0471975511965976));
    }
    const Recognition r = recognise_sweeps(b, add_prism(b, hexagon, 0, 1));
    REQUIRE(r.candidates.size() == 1);
    CHECK(r.candidates[0].shape.cap_edges == 12);
}

TEST_CASE("The rule of choice prefers, in this order, its terms") {
    SweepTopology a, b;
    a.source = FaceId{3};
    b.source = FaceId{4};
    CHECK(better_sweep(a, b));
    CHECK_FALSE(better_sweep(b, a));
    CHECK_FALSE(better_sweep(a, a));
    a.shape.cap_warp = 40;
    CHECK(better_sweep(b, a));
    b.shape.rib_turn = 90;
    CHECK(better_sweep(a, b));
    a.shape.rib_ratio = 3;
    CHECK(better_sweep(b, a));
    a.shape.cap_edges = 12;
    b.shape.cap_edges = 8;
    CHECK(better_sweep(a, b));
    b.shape.cap_loops = 2;
    CHECK(better_sweep(b, a));
    b.shape.corner_deviation = 40;
    CHECK(better_sweep(a, b));
    a.stacked = true;
    CHECK(better_sweep(b, a));
}

TEST_CASE("An unsweepable solid says which face breaks which condition") {
    TestBrep b;
    SECTION("pyramid: every two faces touch") {
        const Recognition r = recognise_sweeps(b, add_pyramid(b));
        CHECK_FALSE(r.sweepable());
        REQUIRE(r.refusals.size() == 3);
        CHECK(r.refusals[0].obstacles[0].condition == SweepCondition::one_source_one_target);
        CHECK(mentions(r.refusals[0].text, " in common with the source"));
    }
    SECTION("boss: a face with two loops") {
        const Recognition r = recognise_sweeps(b, add_boss(b));
        REQUIRE(!r.refusals.empty());
        for (const SweepRefusal& refusal : r.refusals) {
            CHECK(mentions(refusal.text, "face 2: 2 boundary loops where a linking side has one (condition (ii))"));
            const auto& o = refusal.obstacles;
            CHECK(std::any_of(o.begin(), o.end(), [](const SweepObstacle& obstacle) {
                return obstacle.face == FaceId{1} && obstacle.tag == 2 &&
                       obstacle.condition == SweepCondition::four_logical_sides;
            }));
        }
    }
    SECTION("a side face with three logical sides") {
        const SolidId s = add_square_to_triangle(b);
        CHECK_FALSE(recognise_sweeps(b, s).sweepable());
        try {
            (void)sweep_between(b, s, FaceId{0}, FaceId{1});
            FAIL("accepted");
        } catch (const UnmeshableError& e) {
            CHECK(e.code() == ErrorCode::not_sweepable);
            REQUIRE(e.ids().size() == 1);
            const FaceId f{static_cast<std::int32_t>(e.ids()[0]) - 1};
            CHECK(b.face_loops(f)[0].size() == 3);
            CHECK(mentions(e.what(), "three logical sides, only a vertex on the target (condition (ii))"));
        }
    }
    SECTION("caps that share an edge") {
        const SolidId s = add_prism(b, rectangle(1, 1), 0, 1);
        try {
            (void)sweep_between(b, s, FaceId{0}, FaceId{2});
            FAIL("accepted");
        } catch (const UnmeshableError& e) {
            CHECK(mentions(e.what(), "an edge in common"));
        }
    }
    SECTION("caps with different numbers of loops") {
        const SolidId s = add_boss(b);
        CHECK_THROWS_WITH(sweep_between(b, s, FaceId{0}, FaceId{1}),
                          Catch::Contains("face 2: 2 loops, but 1 on the source (condition (i))"));
    }
    SECTION("a box in a box: the cavity is no linking side") {
        const SolidId outer = add_prism(b, rectangle(3, 3), 0, 3);
        std::vector<OrientedFace> faces(b.solid_faces(outer).begin(), b.solid_faces(outer).end());
        const SolidId inner = add_prism(b, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 1, 2);
        for (const OrientedFace& f : b.solid_faces(inner)) {
            faces.push_back({f.face, !f.outward});
        }
        const Recognition r = recognise_sweeps(b, b.solid(std::move(faces)));
        REQUIRE(!r.refusals.empty());
        CHECK(r.refusals[0].obstacles.size() == 6);
        CHECK(mentions(r.refusals[0].text, "no contact with source or target"));
    }
    SECTION("fewer than three faces") {
        const Ring low = add_circle(b, 1, 0);
        const FaceId disc = b.flat({{{low.e, true}}}, {0, 0, 1});
        const Recognition r = recognise_sweeps(b, b.solid({{disc, true}, {disc, false}}));
        REQUIRE(r.refusals.size() == 1);
        CHECK(mentions(r.refusals[0].text, "one of only 2 faces"));
    }
}

TEST_CASE("A sweep whose sides meet a cap tangentially or leave it at a reflex angle is refused") {
    TestBrep b;
    const SolidId tray = add_prism(b, rectangle(2, 2), 0, 1);
    CHECK(recognise_sweeps(b, tray).candidates.size() == 3);
    for (const double spread : {0.0, 8.0, 30.0}) {  // a frustum, flatter and flatter
        TestBrep f;
        const auto low = lift(f,
                              {{-1 - spread, -1 - spread},
                               {1 + spread, -1 - spread},
                               {1 + spread, 1 + spread},
                               {-1 - spread, 1 + spread}},
                              0);
        const auto high = lift(f, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 1);
        std::vector<OrientedFace> faces{{f.flat_polygon(low), false}, {f.flat_polygon(high), true}};
        add_sides(f, low, high, faces);
        const SolidId frustum = f.solid(std::move(faces));
        if (spread < 20) {
            const double expected = 90 - std::atan2(1.0, spread) * 57.29577951308232;
            CHECK(sweep_between(f, frustum, FaceId{0}, FaceId{1}).shape.cap_deviation == Approx(expected).margin(1e-9));
        } else {
            CHECK_THROWS_WITH(sweep_between(f, frustum, FaceId{0}, FaceId{1}),
                              Catch::Contains("faces 3, 4, 5, 6: its angle to a cap differs from 90 degrees by 88"));
            CHECK(recognise_sweeps(f, frustum).candidates.empty());
        }
    }
}

TEST_CASE("best_sweep throws the reasons of an unsweepable solid") {
    TestBrep b;
    const SolidId boss = add_boss(b);
    try {
        (void)best_sweep(b, boss);
        FAIL("accepted");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::not_sweepable);
        CHECK(std::find(e.ids().begin(), e.ids().end(), 2) != e.ids().end());
    }
    const SolidId box = add_prism(b, rectangle(1, 2), 0, 1);
    CHECK(best_sweep(b, box).solid == box);
}

TEST_CASE("Mistakes of the caller are told apart from unsweepable solids") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(1, 1), 0, 1), other = add_prism(b, rectangle(1, 1), 2, 3);
    CHECK_THROWS_AS(sweep_between(b, box, FaceId{0}, FaceId{0}), InputError);
    CHECK_THROWS_AS(sweep_between(b, box, FaceId{0}, b.solid_faces(other)[0].face), InputError);
    CHECK_THROWS_AS(sweep_between(b, box, FaceId{0}, FaceId{}), InputError);
    CHECK_THROWS_AS(sweep_between(b, box, FaceId{0}, FaceId{99}), InputError);
    std::vector<OrientedFace> open(b.solid_faces(box).begin(), b.solid_faces(box).end() - 1);
    try {
        (void)recognise_sweeps(b, b.solid(std::move(open)));
        FAIL("accepted");
    } catch (const InputError& e) {
        CHECK(e.code() == ErrorCode::non_manifold);
    }
}

TEST_CASE("Recognition needs nothing but the brep concept") {
    TestBrep b;
    const SolidId solid = add_prism(b, l_shape(), 0, 1);
    const archetype::Brep model(b);
    const Recognition r = recognise_sweeps(model, solid);
    REQUIRE(r.candidates.size() == 1);
    CHECK(r.candidates[0].loops == recognise_sweeps(b, solid).candidates[0].loops);
    CHECK(sweep_between(model, solid, FaceId{1}, FaceId{0}).source == FaceId{1});
}

#include <pavior/glpk/solve_program.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/recognition.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <string>

using namespace pavior;
using namespace pavior::test;

namespace {

IntervalOptions with_size(double size) {
    IntervalOptions options;
    options.size = size;
    return options;
}

IntervalAssignment assign(const TestBrep& b, const std::vector<SweepTopology>& sweeps, const IntervalOptions& options) {
    return assign_intervals(b, sweeps, options, GlpkSolver{});
}

/// All that an assignment promises.
void verify(const TestBrep& b, const std::vector<SweepTopology>& sweeps, const IntervalAssignment& a,
            int min_loop = 4) {
    REQUIRE(a.intervals.size() == b.edge_count());
    REQUIRE(a.layers.size() == sweeps.size());
    for (std::size_t s = 0; s < sweeps.size(); ++s) {
        const auto placed = place_sides(sweeps[s], a.intervals);  // throws unless opposite sides are equal
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const int around = chain_intervals(sweeps[s].source_loops[i], a.intervals);
            CHECK(around % 2 == 0);
            CHECK(around >= min_loop);
            CHECK(around == chain_intervals(sweeps[s].target_loops[i], a.intervals));
            int covered = 0, highest = 0;
            for (const SidePlacement& side : placed[i]) {
                CHECK(side.columns >= 1);
                CHECK(side.rows >= 1);
                covered += side.columns * side.rows;
                highest = std::max(highest, side.row + side.rows);
            }
            CHECK(highest == a.layers[s]);
            CHECK(covered == around * a.layers[s]);
        }
    }
}

std::string message(const TestBrep& b, const std::vector<SweepTopology>& sweeps, const IntervalOptions& options,
                    Error::Ids& ids) {
    try {
        (void)assign(b, sweeps, options);
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::infeasible_intervals);
        ids = e.ids();
        return e.what();
    }
    return {};
}

/// Triangular prisms over a jittered grid, neighbours sharing walls: every loop of three edges must be even.
std::vector<SweepTopology> add_triangle_grid(TestBrep& b, int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> jitter(-0.25, 0.25);
    std::vector<VertexId> low, high;
    for (int i = 0; i < (n + 1) * (n + 1); ++i) {
        const Vec3 p(i % (n + 1) + jitter(random), i / (n + 1) + jitter(random), 0);
        low.push_back(b.vertex(p));
        high.push_back(b.vertex(p + Vec3(0, 0, 1)));
    }
    std::map<std::pair<std::size_t, std::size_t>, FaceId> walls;
    std::vector<SweepTopology> sweeps;
    for (int cell = 0; cell < 2 * n * n; ++cell) {
        const auto o = static_cast<std::size_t>(cell / 2 % n + (cell / 2 / n) * (n + 1));
        const auto up = static_cast<std::size_t>(n + 1);
        const std::array<std::size_t, 3> t =
            cell % 2 == 0 ? std::array{o, o + 1, o + up + 1} : std::array{o, o + up + 1, o + up};
        std::vector<OrientedFace> faces{{b.flat_polygon({low[t[0]], low[t[1]], low[t[2]]}), false},
                                        {b.flat_polygon({high[t[0]], high[t[1]], high[t[2]]}), true}};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t p = t[k], q = t[(k + 1) % 3];
            const auto [at, fresh] = walls.emplace(std::minmax(p, q), FaceId{});
            if (fresh) {
                at->second = b.flat_polygon({low[p], low[q], high[q], high[p]});
            }
            faces.push_back({at->second, fresh});
        }
        sweeps.push_back(best_sweep(b, b.solid(std::move(faces))));
    }
    return sweeps;
}

}  // namespace

TEST_CASE("A box gets length over size where that is a whole number") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(2, 3), 0, 4);
    const std::vector sweeps{best_sweep(b, box)};
    const IntervalAssignment a = assign(b, sweeps, with_size(0.5));
    verify(b, sweeps, a);
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        CHECK(a.intervals[e] == std::lround(b.edge_length({static_cast<std::int32_t>(e)}) / 0.5));
    }
    CHECK(a.layers == std::vector{8});
    CHECK(a.objective == Approx(0).margin(1e-12));
    CHECK(a.worst_ratio == Approx(1));
    CHECK(a.optimal);
    CHECK(a.angles_kept);
}

TEST_CASE("All rules hold for any size") {
    TestBrep b;
    const Polygon hole{{0.2, 0.2}, {0.2, 0.6}, {0.6, 0.6}, {0.6, 0.2}}, slit{{1.2, 0.2}, {1.4, 0.7}, {1.6, 0.2}};
    const std::vector<SolidId> solids{add_prism(b, l_shape(), 0, 1, {hole, slit}), add_cylinder(b, 2, 1.5, 3, 0.5),
                                      add_prism(b, {{0, 0}, {3, 0}, {1, 2}}, 0, 1), add_half_stacked_box(b),
                                      add_prism(b, l_shape(), 0, 1, {slit}, 3)};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> exponent(-3.5, 1.5);
    for (const SolidId solid : solids) {
        const std::vector sweeps{best_sweep(b, solid)};
        for (int trial = 0; trial < 20; ++trial) {
            verify(b, sweeps, assign(b, sweeps, with_size(std::exp(exponent(random)))));
        }
    }
}

TEST_CASE("A huge size gives the coarsest mesh, arcs keep their shape") {
    TestBrep b;
    const std::vector box{best_sweep(b, add_prism(b, rectangle(2, 3), 0, 4))};
    CHECK(assign(b, box, with_size(1e9)).layers == std::vector{1});
    const std::vector pipe{best_sweep(b, add_cylinder(b, 2, 2, 3, 0.5))};
    const IntervalAssignment a = assign(b, pipe, with_size(1e9));
    CHECK(chain_intervals(pipe[0].source_loops[0], a.intervals) == 12);
    CHECK(chain_intervals(pipe[0].target_loops[1], a.intervals) == 12);
    IntervalOptions finer = with_size(1e9);
    finer.max_angle = 20;
    CHECK(chain_intervals(pipe[0].source_loops[0], assign(b, pipe, finer).intervals) == 18);
}

TEST_CASE("Sizes of edges go before those of faces, solids and the model") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(4, 4), 0, 4);
    const std::vector sweeps{sweep_between(b, box, FaceId{0}, FaceId{1})};
    IntervalOptions options = with_size(1);
    options.solid_size[1] = 2;
    CHECK(assign(b, sweeps, options).layers == std::vector{2});
    options.face_size[3] = 0.5;
    const LinkingSide* side = nullptr;
    for (const LinkingSide& s : sweeps[0].loops[0]) {
        side = s.face == FaceId{2} ? &s : side;
    }
    REQUIRE(side != nullptr);
    const IntervalAssignment a = assign(b, sweeps, options);
    CHECK(chain_intervals(side->bottom, a.intervals) == 8);
    IntervalOptions both = options;
    both.face_size[1] = 0.25;  // the smallest face size at an edge counts
    CHECK(chain_intervals(side->bottom, assign(b, sweeps, both).intervals) > 8);
    for (const EdgeChain* chain : {&side->bottom, &side->top}) {
        options.edge_size[chain->front().edge.value + 1] = 1;
    }
    CHECK(chain_intervals(side->bottom, assign(b, sweeps, options).intervals) == 4);
}

TEST_CASE("Layers and intervals can be prescribed") {
    TestBrep b;
    const auto row = add_box_row(b, {0, 1, 3});
    const std::vector sweeps{sweep_between(b, row[0], FaceId{0}, FaceId{1}),
                             sweep_between(b, row[1], FaceId{1}, FaceId{2})};
    IntervalOptions options = with_size(0.3);
    options.layers = 5;
    options.solid_layers[2] = 2;
    const IntervalAssignment a = assign(b, sweeps, options);
    verify(b, sweeps, a);
    CHECK(a.layers == std::vector{5, 2});
    const EdgeId shared = sweeps[0].target_loops[0][0].edge;
    options.edge_intervals[shared.value + 1] = 7;
    const IntervalAssignment c = assign(b, sweeps, options);
    verify(b, sweeps, c);
    CHECK(c.intervals[shared.index()] == 7);
    CHECK(chain_intervals(sweeps[0].source_loops[0], c.intervals) ==
          chain_intervals(sweeps[1].target_loops[0], c.intervals));
}

TEST_CASE("Prescribed layers win over the angle of an arc, and the result says so") {
    TestBrep b;  // half a ring, swept along its arcs
    std::vector<VertexId> v;
    for (const double x : {1.0, 2.0, -2.0, -1.0}) {
        v.push_back(b.vertex({x, 0, 0}));
        v.push_back(b.vertex({x, 0, 1}));
    }
    const auto bow = [&](std::size_t from, std::size_t to, double z) {
        return OrientedEdge{b.arc(v[from], v[to], {0, 0, z}, {0, 0, 1}), true};
    };
    const OrientedEdge in0 = bow(0, 6, 0), in1 = bow(1, 7, 1), out0 = bow(2, 4, 0), out1 = bow(3, 5, 1);
    const auto back = [](OrientedEdge use) { return OrientedEdge{use.edge, !use.forward}; };
    const auto line = [&](std::size_t from, std::size_t to) { return b.joint(v[from], v[to]); };
    const FaceId start = b.flat({{line(0, 2), line(2, 3), line(3, 1), line(1, 0)}}, {0, -1, 0});
    const FaceId stop = b.flat({{line(4, 6), line(6, 7), line(7, 5), line(5, 4)}}, {0, -1, 0});
    const FaceId floor = b.flat({{line(0, 2), out0, line(4, 6), back(in0)}}, {0, 0, 1});
    const FaceId roof = b.flat({{line(1, 3), out1, line(5, 7), back(in1)}}, {0, 0, 1});
    const FaceId outer = b.wall(out0.edge, out1.edge, {{out0, line(4, 5), back(out1), line(3, 2)}});
    const FaceId inner = b.wall(in0.edge, in1.edge, {{in0, line(6, 7), back(in1), line(1, 0)}});
    const SolidId solid =
        b.solid({{start, true}, {stop, true}, {floor, false}, {roof, true}, {outer, true}, {inner, false}});
    const std::vector sweeps{sweep_between(b, solid, start, stop)};
    CHECK(sweeps[0].shape.rib_turn == Approx(180));
    CHECK(sweeps[0].shape.rib_ratio == Approx(2));
    CHECK(best_sweep(b, solid).source == floor);  // straight ribs of equal length are preferred
    IntervalOptions options = with_size(100);
    const IntervalAssignment free = assign(b, sweeps, options);
    CHECK(free.layers == std::vector{6});
    CHECK(free.angles_kept);
    options.layers = 2;
    const IntervalAssignment forced = assign(b, sweeps, options);
    verify(b, sweeps, forced);
    CHECK(forced.layers == std::vector{2});
    CHECK_FALSE(forced.angles_kept);
}

TEST_CASE("Contradicting demands are named") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(2, 3), 0, 4), tower = add_prism(b, rectangle(1, 1), 0, 3, {}, 3);
    const std::vector boxes{sweep_between(b, box, FaceId{0}, FaceId{1})};
    const std::vector towers{best_sweep(b, tower)};
    Error::Ids ids;
    SECTION("an edge and its opposite") {
        const LinkingSide& side = boxes[0].loops[0][1];
        const std::string bottom = std::to_string(side.bottom[0].edge.value + 1);
        const std::string top = std::to_string(side.top[0].edge.value + 1);
        IntervalOptions options = with_size(1);
        options.edge_intervals = {{std::stoi(bottom), 3}, {std::stoi(top), 4}};
        options.layers = 6;  // harmless, must not be blamed
        const std::string text = message(b, boxes, options, ids);
        CHECK_THAT(text, Catch::Contains("edge " + bottom + " has 3 intervals"));
        CHECK_THAT(text, Catch::Contains("edge " + top + " has 4 intervals"));
        CHECK_THAT(text, Catch::Contains("opposite sides of face " + std::to_string(side.face.value + 1)));
        CHECK(std::count(text.begin(), text.end(), '\n') == 3);
        CHECK(ids == Error::Ids{side.face.value + 1});
    }
    SECTION("an odd loop") {
        IntervalOptions options = with_size(1);
        for (std::size_t i = 0; i < 4; ++i) {
            options.edge_intervals[boxes[0].source_loops[0][i].edge.value + 1] = i == 0 ? 2 : 3;
        }
        const std::string text = message(b, boxes, options, ids);
        CHECK_THAT(text, Catch::Contains("of cap 1 is even"));
        CHECK(std::count(text.begin(), text.end(), '\n') == 5);
        CHECK(ids == Error::Ids{1});
    }
    SECTION("fewer layers than storeys") {
        IntervalOptions options = with_size(1);
        options.layers = 2;
        const std::string text = message(b, towers, options, ids);
        CHECK_THAT(text, Catch::Contains("solid 2 has 2 layers"));
        CHECK(std::count(text.begin(), text.end(), '\n') == 1);
        CHECK(ids.size() == 3);
    }
}

TEST_CASE("Options that make no sense are refused") {
    TestBrep b;
    const std::vector sweeps{best_sweep(b, add_prism(b, rectangle(2, 3), 0, 4))};
    IntervalOptions options;
    CHECK_THROWS_AS(assign(b, sweeps, options), InputError);
    options.size = 1;
    options.layers = 0;
    CHECK_THROWS_AS(assign(b, sweeps, options), InputError);
    options.layers.reset();
    options.face_size[1] = -1;
    CHECK_THROWS_AS(assign(b, sweeps, options), InputError);
    options.face_size.clear();
    options.max_angle = 0;
    CHECK_THROWS_AS(assign(b, sweeps, options), InputError);
    options.max_angle = 45;
    options.size = 1e-9;
    CHECK_THROWS_AS(assign(b, sweeps, options), InputError);
}

TEST_CASE("Triangular prisms that share walls get even loops all at once") {
    TestBrep b;
    const std::vector<SweepTopology> sweeps = add_triangle_grid(b, 5, 3);
    for (const double size : {0.9, 0.3, 0.05}) {
        const IntervalAssignment a = assign(b, sweeps, with_size(size));
        verify(b, sweeps, a);
        CHECK(a.optimal);
        CHECK(a.worst_ratio <= 2.0);
        CHECK(a.intervals == assign(b, sweeps, with_size(size)).intervals);
    }
}

TEST_CASE("No sweeps, no intervals") {
    TestBrep b;
    add_prism(b, rectangle(2, 3), 0, 4);
    const IntervalAssignment a = assign(b, {}, with_size(1));
    CHECK(a.intervals == std::vector<int>(b.edge_count(), 0));
    CHECK(a.layers.empty());
}

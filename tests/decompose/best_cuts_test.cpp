#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"
#include "support/voxel_cutter.hpp"

#include <pavior/decompose/best_cuts.hpp>
#include <pavior/glpk/solve_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

const std::vector<SolidId> first_solid{SolidId{0}};
constexpr auto endless = [] { return false; };

/// A stair of steps of different sizes; as many as there are, it is cut into one box less.
Voxels stair(int steps) {
    Voxels voxels(steps, 1, steps);
    for (int i = 0; i < steps; ++i) {
        voxels.fill({i, 0, 0}, {i + 1, 1, steps - i}, 1);
    }
    for (std::size_t p = 1; p < voxels.at[0].size(); ++p) {
        voxels.at[0][p] = voxels.at[0][p - 1] + 1 + 0.25 * static_cast<double>(p);
        voxels.at[2][p] = voxels.at[2][p - 1] + 1 + 0.125 * static_cast<double>(p);
    }
    return voxels;
}

/// What has no notch is a box here.
template <class Pieces>
bool are_boxes(const Pieces& pieces, std::span<const SolidId> solids) {
    return std::all_of(solids.begin(), solids.end(), [&](SolidId s) {
        const std::vector<EdgeAngle> angles = edge_angles(*pieces.model, s);
        return std::none_of(angles.begin(), angles.end(), [](const EdgeAngle& angle) { return angle.concave(); });
    });
}

bool all_boxes(const VoxelPieces& pieces) { return are_boxes(pieces, all_solids(*pieces.model)); }

/// Content with pieces all of which are boxes. Notes what it is shown.
struct BoxesWanted {
    double content = 0.9, others = 0.01;
    std::size_t calls = 0;
    std::vector<double> given = {};

    PiecesVerdict operator()(const VoxelPieces& pieces, std::span<const SolidId> solids,
                             std::span<const PieceMethods> methods) {
        ++calls;
        CHECK(solids.size() == methods.size());
        CHECK(std::all_of(methods.begin(), methods.end(), [](const PieceMethods& m) { return m.any(); }));
        for (const SolidId s : solids) {
            CHECK(s.index() < (*pieces.model).solid_count());
        }
        given.push_back(all_boxes(pieces) ? content : others);
        return {given.back(), {}};
    }
};

bool same_cuts(const std::vector<SolidCut>& a, const std::vector<SolidCut>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SolidCut& x, const SolidCut& y) {
        return x.solid == y.solid && x.reason == y.reason &&
               std::equal(x.surfaces.begin(), x.surfaces.end(), y.surfaces.begin(), y.surfaces.end(),
                          [](const CutSurface& s, const CutSurface& t) { return same_surface(s, t, 1e-15); });
    });
}

/// The numbers of the solid among which \p of is one, by pieces.
std::size_t pieces_of(const VoxelPieces& pieces, SolidId of) {
    return static_cast<std::size_t>(std::count(pieces.solid.begin(), pieces.solid.end(), of));
}

}  // namespace

TEST_CASE("Cuts are found after which all pieces are as the verdict wants them") {
    for (const Voxels& voxels : {stair(2), stair(3), stair(4), star()}) {
        for (const bool flipped : {false, true}) {
            VoxelCutter cutter(voxels);
            cutter.flipped = flipped;
            BoxesWanted verdict;
            CutSearchOptions options;
            options.max_cuts = options.max_meshes = 2000;
            const CutSearch found =
                best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
            CAPTURE(voxels.size[0], found.tried, found.meshed);
            CHECK(found.quality == verdict.content);
            CHECK(found.tried == cutter.calls);
            CHECK(found.meshed == verdict.calls);
            REQUIRE_FALSE(found.cuts.empty());
            const std::optional<VoxelPieces> pieces = cutter(found.cuts);
            REQUIRE(pieces);
            CHECK(all_boxes(*pieces));
            CHECK(pieces->solid.size() > 1);
            double volume = 0;
            for (std::size_t s = 0; s < pieces->solid.size(); ++s) {
                CHECK(pieces->solid[s] == SolidId{0});
                volume += pieces->model.voxels().volume(static_cast<int>(s) + 1);
            }
            CHECK(volume == Approx(voxels.volume(1)));
        }
    }
}

TEST_CASE("Nothing more is tried once a mesh is sufficient") {
    VoxelCutter cutter(stair(3));
    BoxesWanted verdict;
    CutSearchOptions options;
    options.sufficient = 0.9;
    const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
    CHECK(found.quality == 0.9);
    CHECK(std::count(verdict.given.begin(), verdict.given.end(), 0.9) == 1);
    CHECK(verdict.given.back() == 0.9);
}

TEST_CASE("The best is kept, with the cuts that it came of, where nothing is sufficient") {
    const auto judge = [](const VoxelPieces& pieces) {  // no order in it
        double sum = 0;
        for (const SolidId s : all_solids(*pieces.model)) {
            sum += pieces.model.voxels().volume(s.value + 1) * (1 + s.value);
        }
        return 0.5 + 0.5 * std::sin(37 * sum);
    };
    VoxelCutter cutter(star());
    std::vector<double> given;
    const auto verdict = [&](const VoxelPieces& pieces, std::span<const SolidId>, std::span<const PieceMethods>) {
        given.push_back(judge(pieces));
        return PiecesVerdict{given.back(), {}};
    };
    CutSearchOptions options;
    options.sufficient = 2;
    const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
    REQUIRE(given.size() > 1);
    CHECK(found.quality == *std::max_element(given.begin(), given.end()));
    REQUIRE_FALSE(found.cuts.empty());
    CHECK(judge(*cutter(found.cuts)) == found.quality);
}

TEST_CASE("A verdict that has no mesh of anything leaves nothing") {
    VoxelCutter cutter(stair(3));
    BoxesWanted verdict{-1, -1};
    CutSearchOptions options;
    options.max_cuts = 40;
    const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
    CHECK(verdict.calls > 0);
    CHECK(found.cuts.empty());
    CHECK(found.quality < 0);
}

TEST_CASE("Tries of the cutter, meshes and pieces are limited") {
    CutSearchOptions options;
    options.sufficient = 2;
    for (const std::size_t limit : {1U, 2U, 3U, 7U}) {
        CAPTURE(limit);
        VoxelCutter cutter(star());
        BoxesWanted verdict;
        options.max_cuts = limit;
        const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
        CHECK(cutter.calls <= limit);
        CHECK(found.tried == cutter.calls);
    }
    options.max_cuts = 1000;
    for (const std::size_t limit : {1U, 2U, 4U}) {
        CAPTURE(limit);
        VoxelCutter cutter(star());
        BoxesWanted verdict;
        options.max_meshes = limit;
        const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
        CHECK(verdict.calls == limit);
        CHECK(found.meshed == limit);
    }
    options.max_meshes = 1000;
    options.max_pieces = 1;
    VoxelCutter cutter(star());
    BoxesWanted verdict;
    CHECK(best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options).cuts.empty());
    CHECK(verdict.calls == 0);
}

TEST_CASE("Time that is over ends the search, and what was found until then stays") {
    {
        VoxelCutter cutter(stair(4));
        BoxesWanted verdict;
        const CutSearch none = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, [] { return true; });
        CHECK(none.cuts.empty());
        CHECK(verdict.calls == 0);
        CHECK(cutter.calls <= 1);
    }
    VoxelCutter cutter(stair(4));
    BoxesWanted verdict{0.5, 0.1};
    CutSearchOptions options;
    options.sufficient = 2;
    std::size_t calls = 0;  // of the cutter when the time was over
    const auto out_of_time = [&] {
        if (verdict.calls < 2) {
            calls = cutter.calls;
        }
        return verdict.calls >= 2;
    };
    const CutSearch found = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, out_of_time, options);
    CHECK(verdict.calls == 2);
    CHECK(cutter.calls <= calls + 1);
    CHECK(found.quality == *std::max_element(verdict.given.begin(), verdict.given.end()));
    CHECK_FALSE(found.cuts.empty());
}

TEST_CASE("A stop that is asked for ends the search by Stopped") {
    std::stop_source source;
    VoxelCutter cutter(star());
    CutSearchOptions options;
    options.sufficient = 2;
    options.stop = source.get_token();
    std::size_t meshed = 0;
    const auto verdict = [&](const VoxelPieces&, std::span<const SolidId>, std::span<const PieceMethods>) {
        ++meshed;
        source.request_stop();
        return PiecesVerdict{0.1, {}};
    };
    CHECK_THROWS_AS(best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options), Stopped);
    CHECK(meshed == 1);
    BoxesWanted never;
    CHECK_THROWS_AS(best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, never, endless, options), Stopped);
    CHECK(never.calls == 0);
}

TEST_CASE("What a callable throws comes out") {
    VoxelCutter cutter(star());
    const auto verdict = [](const VoxelPieces&, std::span<const SolidId>,
                            std::span<const PieceMethods>) -> PiecesVerdict { throw std::length_error("full"); };
    CHECK_THROWS_AS(best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless), std::length_error);
}

TEST_CASE("A cutter that makes nothing, or nothing of its cuts, leaves nothing") {
    std::size_t calls = 0;
    const auto nothing = [&](std::span<const SolidCut>) -> std::optional<VoxelPieces> {
        ++calls;
        return std::nullopt;
    };
    BoxesWanted verdict;
    CHECK(best_cuts<VoxelPieces>(first_solid, nothing, GlpkSolver{}, verdict, endless).cuts.empty());
    CHECK(calls == 1);
    VoxelCutter cutter(star());
    const auto whole = [&](std::span<const SolidCut> cuts) {
        return cuts.empty() ? cutter(cuts) : std::optional<VoxelPieces>{};
    };
    const CutSearch none = best_cuts<VoxelPieces>(first_solid, whole, GlpkSolver{}, verdict, endless);
    CHECK(none.cuts.empty());
    CHECK(none.tried > 1);
    CHECK(verdict.calls == 0);
}

TEST_CASE("Solids that were not asked for stay whole") {
    Voxels voxels(3, 1, 4);
    voxels.fill({0, 0, 0}, {3, 1, 2}, 1);
    voxels.fill({2, 0, 1}, {3, 1, 2}, 2);
    voxels.fill({0, 0, 2}, {3, 1, 4}, 3);
    voxels.fill({0, 0, 3}, {1, 1, 4}, 0);
    for (const auto& wanted :
         {std::vector<SolidId>{SolidId{0}}, {SolidId{2}}, {SolidId{0}, SolidId{2}}, {SolidId{2}, SolidId{0}}}) {
        VoxelCutter cutter(voxels);
        const auto verdict = [&](const VoxelPieces& pieces, std::span<const SolidId> solids,
                                 std::span<const PieceMethods>) {
            for (const SolidId s : solids) {
                CHECK(std::find(wanted.begin(), wanted.end(), pieces.solid[s.index()]) != wanted.end());
            }
            return PiecesVerdict{are_boxes(pieces, solids) ? 0.9 : 0.1, {}};
        };
        const CutSearch found = best_cuts<VoxelPieces>(wanted, cutter, GlpkSolver{}, verdict, endless);
        CHECK(found.quality == 0.9);
        const std::optional<VoxelPieces> pieces = cutter(found.cuts);
        REQUIRE(pieces);
        for (const SolidId s : {SolidId{0}, SolidId{1}, SolidId{2}}) {
            CAPTURE(s.value);
            const bool asked = std::find(wanted.begin(), wanted.end(), s) != wanted.end();
            CHECK((pieces_of(*pieces, s) > 1) == asked);
        }
    }
}

TEST_CASE("The same cuts each time") {
    for (const Voxels& voxels : {stair(4), star()}) {
        CutSearchOptions options;
        options.sufficient = 2;
        const auto run = [&] {
            VoxelCutter cutter(voxels);
            BoxesWanted verdict;
            return best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, verdict, endless, options);
        };
        const CutSearch one = run();
        const CutSearch two = run();
        CHECK(same_cuts(one.cuts, two.cuts));
        CHECK(one.quality == two.quality);
        CHECK(one.tried == two.tried);
        CHECK(one.meshed == two.meshed);
    }
}

namespace {

/// Pieces whose model has nothing but what brep asks for.
struct BarePieces {
    std::shared_ptr<const archetype::Brep<TestBrep>> model;
    std::vector<SolidId> solid;
};

}  // namespace

TEST_CASE("The search needs nothing but the concepts") {
    VoxelCutter cutter(stair(3));
    BoxesWanted wanted;
    const CutSearch expected = best_cuts<VoxelPieces>(first_solid, cutter, GlpkSolver{}, wanted, endless);
    struct Kept {
        VoxelPieces pieces;
        archetype::Brep<TestBrep> bare;
        explicit Kept(VoxelPieces p) : pieces(std::move(p)), bare(*pieces.model) {}
    };
    archetype::Callable<std::optional<BarePieces>(std::span<const SolidCut>)> bare_cutter(
        [&](std::span<const SolidCut> cuts) -> std::optional<BarePieces> {
            std::optional<VoxelPieces> pieces = cutter(cuts);
            if (!pieces) {
                return std::nullopt;
            }
            const auto kept = std::make_shared<const Kept>(std::move(*pieces));
            return BarePieces{{kept, &kept->bare}, kept->pieces.solid};
        });
    archetype::Callable<IntegerSolution(const IntegerProgram&)> solver(
        [](const IntegerProgram& program) { return solve(program); });
    archetype::Callable<PiecesVerdict(const BarePieces&, std::span<const SolidId>, std::span<const PieceMethods>)>
        verdict([](const BarePieces& pieces, std::span<const SolidId> solids, std::span<const PieceMethods>) {
            return PiecesVerdict{are_boxes(pieces, solids) ? 0.9 : 0.01, {}};
        });
    archetype::Callable<bool()> out_of_time([] { return false; });
    const CutSearch found = best_cuts<BarePieces>(first_solid, bare_cutter, solver, verdict, out_of_time);
    CHECK(found.quality == 0.9);
    CHECK(same_cuts(found.cuts, expected.cuts));
    CHECK(solver.calls() > 0);
    CHECK(out_of_time.calls() > 0);
}

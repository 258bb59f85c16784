// The headers of smooth/detail/, each called as the room calls it.
#include "smooth/meshes.hpp"
#include "support/catch.hpp"

#include <pavior/math/hexahedron.hpp>
#include <pavior/smooth/detail/cartesian_model.hpp>
#include <pavior/smooth/detail/cell_energy.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/detail/cell_sum.hpp>
#include <pavior/smooth/detail/contradictions.hpp>
#include <pavior/smooth/detail/foldover.hpp>
#include <pavior/smooth/detail/guide_view.hpp>
#include <pavior/smooth/detail/guided_model.hpp>
#include <pavior/smooth/detail/patch.hpp>
#include <pavior/smooth/detail/patch_schedule.hpp>
#include <pavior/smooth/detail/scaled_barrier.hpp>
#include <pavior/smooth/detail/surface_model.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/detail/worst_first.hpp>
#include <pavior/smooth/node_guide.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace pavior;
using pavior_test::hex_grid;
using pavior_test::HexGrid;
using pavior_test::quad_grid;

namespace {

constexpr Index middle = 13;  // of a grid of 2 x 2 x 2 cubes

// The grid with its middle node first: what CellSum wants.
struct Star {
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 27);
    std::vector<HexCorners> cells;

    explicit Star(const HexGrid& grid = hex_grid(2, 2, 2)) : cells(grid.hexes) {
        for (Index i = 0; i < 27; ++i) {
            points.col(place(i)) = grid.nodes[i];
        }
        for (HexCorners& c : cells) {
            std::transform(c.begin(), c.end(), c.begin(), [](Index i) { return static_cast<Index>(place(i)); });
        }
    }
    static Eigen::Index place(Index i) { return i == middle ? 0 : i < middle ? i + 1 : i; }
};

HexGrid moved(const Vec3& to) {
    HexGrid grid = hex_grid(2, 2, 2);
    grid.nodes[middle] = to;
    return grid;
}

// Central differences of value(x) against its gradient.
template <class Value>
void check_gradient(const Eigen::VectorXd& x, const Value& value) {
    Eigen::VectorXd gradient(x.size()), unused(x.size());
    value(x, gradient);
    for (Eigen::Index k = 0; k < x.size(); ++k) {
        Eigen::VectorXd plus = x, minus = x;
        plus[k] += 1e-6;
        minus[k] -= 1e-6;
        CHECK(gradient[k] == Approx((value(plus, unused) - value(minus, unused)) / 2e-6).epsilon(1e-4).margin(1e-6));
    }
}

struct Plane {
    [[nodiscard]] static Vec3 point(const Vec2& uv) { return {2 * uv[0], uv[1], 0}; }
    [[nodiscard]] static std::pair<Vec3, Vec3> derivatives(const Vec2&) { return {{2, 0, 0}, {0, 1, 0}}; }
};

}  // namespace

TEST_CASE("shapes of cells: a box, a quad, a folded one") {
    detail::CellPoints<3> box;
    box << 0, 2, 2, 0, 0, 2, 2, 0, 0, 0, 3, 3, 0, 0, 3, 3, 0, 0, 0, 0, 4, 4, 4, 4;
    CHECK(detail::scaled_jacobian<3>(box, 19) == Approx(1.0));
    CHECK(detail::signed_measure<3>(box) == Approx(24.0));
    CHECK(detail::sample_jacobian(box, detail::hex_samples[0]).diagonal().isApprox(Vec3(2, 3, 4)));
    box.row(0) *= -1.0;
    CHECK(detail::scaled_jacobian<3>(box, 0) == Approx(-1.0));
    detail::CellPoints<2> quad;
    quad << 0, 1, 1, 0, 0, 0, 2, 1;
    CHECK(detail::signed_measure<2>(quad) == Approx(1.5));
    CHECK(detail::scaled_jacobian<2>(quad, 0) == Approx(std::sqrt(0.5)));
    CHECK(detail::scaled_determinant<2>(Eigen::Matrix2d::Zero()) == 0.0);
    CHECK(detail::unit_of<2>(std::vector<Vec2>{{1, 1}, {6, 1}}) == 4.0);
    const detail::HexGradient g = detail::hex_gradient(0.3, 0.6, 0.9);
    for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (const auto& row : g) {
            sum += row[k];
        }
        CHECK(sum == Approx(0.0).margin(1e-15));
    }
    CHECK(detail::sample_count<3>(HexPositivity::sampled) == 19);
    CHECK(detail::sample_count<2>(HexPositivity::sampled) == 0);
}

TEST_CASE("the energy of cubes is one a simplex; its gradient is that of its values") {
    const Star star;
    detail::CellEnergy<3> energy(star.points, star.cells, 1, 0, sequential);
    Eigen::VectorXd gradient(3);
    const detail::EnergyMode strict{0.0, 0.5, 0.0};
    const detail::EnergyValue at = energy.evaluate(energy.free_nodes(), strict, gradient);
    CHECK(at.energy == Approx(32.0));  // in each of eight cubes the middle and its three neighbours
    CHECK(at.min_det == Approx(1.0));
    CHECK(at.max_distortion == Approx(1.0));
    CHECK(gradient.norm() < 1e-12);
    CHECK(energy.quality(energy.free_nodes()) == Approx(1.0));
    check_gradient(Eigen::Vector3d(1.2, 0.9, 1.3), [&](const Eigen::VectorXd& x, Eigen::VectorXd& slope) {
        return energy.evaluate(x, strict, slope).energy;
    });
    check_gradient(Eigen::Vector3d(2.5, 1.0, 1.0), [&](const Eigen::VectorXd& x, Eigen::VectorXd& slope) {
        return energy.evaluate(x, {0.3, 0.5, 0.0}, slope).energy;
    });
    CHECK(std::isinf(energy.evaluate(Eigen::Vector3d(2.5, 1, 1), strict, gradient).energy));
    CHECK(energy.evaluate(Eigen::Vector3d(2.5, 1, 1), {1.0, 0.5, 0.0}, gradient).min_det < 0.0);

    detail::CellSum<3>& sum = energy;
    CHECK(sum.cell_count() == 8);
    CHECK(sum.free_count() == 1);
    CHECK(sum.simplices_per_cell() == 8);
    sum.leave_out(0, 0xFF);
    CHECK(energy.evaluate(Eigen::Vector3d(1, 1, 1), strict, gradient).energy == Approx(28.0));
}

TEST_CASE("the barrier of scaled determinants is infinite at its floor and pushes away from it") {
    const Star star;
    detail::ScaledBarrier barrier(star.points, star.cells, 1, 0, sequential);
    Eigen::VectorXd gradient(3);
    const Eigen::Vector3d off(1.3, 1.2, 0.9);
    const double quality = barrier.quality(off);
    CHECK(quality < 0.99);
    CHECK(std::isinf(barrier.evaluate(off, {quality, 0.1}, gradient)));
    CHECK(barrier.evaluate(off, {quality - 0.2, 0.1}, gradient) <
          barrier.evaluate(off, {quality - 0.1, 0.1}, gradient));
    check_gradient(off, [&](const Eigen::VectorXd& x, Eigen::VectorXd& slope) {
        return barrier.evaluate(x, {quality - 0.1, 0.1}, slope);
    });
    Eigen::VectorXd x = off;
    Lbfgs lbfgs;
    const LbfgsResult raised = detail::raise_scaled(barrier, x, 1.0, lbfgs);
    CHECK(raised.value > quality);
    CHECK(barrier.quality(x) == Approx(raised.value));
}

TEST_CASE("epsilon falls as the energy does, and a node outside of its star comes back") {
    CHECK(detail::next_epsilon(1.0, 0.5, 1.0, 0.4) == Approx(0.4));
    CHECK(detail::next_epsilon(1.0, 0.5, 1.0, 1.0) == Approx(0.9));
    CHECK(detail::next_epsilon(1.0, 0.5, 1.0, 1.0, 0.3) == Approx(0.7));
    const double slow = detail::next_epsilon(1.0, -2.0, 1.0, 1.0);
    CHECK(slow < 1.0);
    CHECK(slow > 0.9);
    detail::Stagnation stagnation;
    CHECK_FALSE(stagnation.stuck(1.0, -1.0, true));
    CHECK(stagnation.stuck(0.01, -1.0, true));

    const Star star;
    detail::CellEnergy<3> energy(star.points, star.cells, 1, 1, sequential);
    Eigen::VectorXd x = Eigen::Vector3d(2.5, 1.1, 0.8);
    REQUIRE(energy.quality(x) < 0.0);
    Lbfgs lbfgs;
    CHECK(detail::solve_patch(energy, x, 0.9, {}, lbfgs) > 0);
    CHECK(energy.quality(x) > 0.9);
    CHECK((x - Eigen::Vector3d(1, 1, 1)).norm() < 0.1);
}

TEST_CASE("a direction within all half-spaces is found where there is one") {
    const std::vector<Vec3> open{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto found = detail::direction_in_cone<3>(open, Vec3(-1, -1, -1));
    CHECK(found.inside == 3);
    CHECK(found.direction.minCoeff() > 0.0);
    CHECK(detail::direction_in_cone<2>(std::vector<Vec2>{{1, 0}, {-1, 0}}, Vec2(0, 1)).inside == 1);

    const HexGrid grid = moved({2.5, 1, 1});  // inverted, but nothing contradicts
    const detail::PatchFinder<3> finder(grid.hexes, grid.fixed);
    const auto points = [&](Index c) {
        return detail::cell_points<3>(std::span<const Vec3>(grid.nodes), grid.hexes[c], 1.0);
    };
    detail::ContradictionFinder<3, decltype(points)> contradictions(grid.hexes, grid.fixed, finder, points);
    CHECK(contradictions.find(std::vector<Index>{1, 3, 5, 7}).empty());
}

TEST_CASE("patches hold the free nodes round their seeds, and each is worked on once") {
    const HexGrid grid = hex_grid(5, 3, 3);  // 4 x 2 x 2 free nodes
    detail::PatchFinder<3> finder(grid.hexes, grid.fixed);
    const auto one = finder.find(std::vector<Index>{0}, 1);
    REQUIRE(one.size() == 1);
    CHECK(one[0].free_count == 1);
    CHECK(one[0].cells.size() == 8);
    CHECK_FALSE(one[0].complete);
    const auto two = finder.find(std::vector<Index>{0, 4}, 1);
    REQUIRE(two.size() == 2);
    const auto all = finder.find(std::vector<Index>{0}, 9);
    REQUIRE(all.size() == 1);
    CHECK(all[0].complete);
    CHECK(all[0].free_count == 16);
    CHECK(all[0].cell_ids.size() == 45);
    for (std::size_t k = 0; k < all[0].cells.size(); ++k) {
        for (std::size_t c = 0; c < 8; ++c) {
            CHECK(all[0].nodes[all[0].cells[k][c]] == grid.hexes[all[0].cell_ids[k]][c]);
        }
    }
    for (const unsigned threads : {1U, 2U}) {
        std::vector<int> calls(two.size(), 0);
        detail::for_each_patch(
            Execution{threads}, two, [](const auto&) { return true; },
            [&](std::size_t k, const Execution& execution) {
                ++calls[k];
                CHECK(execution.threads == 1);
            });
        CHECK(calls == std::vector<int>{1, 1});
    }
}

TEST_CASE("models judge, bound and mend cells, with and without a guide") {
    const UntangleOptions options;
    HexGrid grid = moved({2.5, 1, 1});
    detail::check_mesh<3>(grid.nodes, grid.hexes, grid.fixed.size(), {});
    CHECK_THROWS_AS(detail::check_mesh<3>(grid.nodes, grid.hexes, 3, {}), InputError);
    CHECK_THROWS_AS(detail::check_cells<3>(grid.hexes, 20, 20), InputError);
    detail::CartesianModel<3> model(grid.nodes, grid.hexes, grid.fixed, {}, options);
    const std::vector<double> before = detail::scan_quality(model, grid.hexes.size(), sequential);
    CHECK(std::count_if(before.begin(), before.end(), detail::is_inverted) == 4);
    CHECK(model.bound(0) == Approx(1.0));
    CHECK_FALSE(model.hopeless(1));
    detail::PatchFinder<3> finder(grid.hexes, grid.fixed);
    const auto patches = finder.find(std::vector<Index>{0}, 1);
    const auto saved = model.save(patches.at(0));
    CHECK(model.solve(patches[0], 0.9, sequential) > 0);
    CHECK(model.quality(0) > 0.9);
    model.restore(patches[0], saved);
    CHECK(grid.nodes[middle] == Vec3(2.5, 1, 1));

    // The middle may slide on the plane x = 1.2 only.
    std::vector<Freedom> freedoms(27, Freedom::fixed);
    freedoms[middle] = Freedom::surface;
    const GuidedNodes guide{std::span<const Freedom>(freedoms),
                            [](Index, const Vec3& x) { return Vec3(1.2, x[1], x[2]); }};
    grid.nodes[middle] = {1.2, 1.6, 0.5};
    detail::GuidedModel guided(grid.nodes, grid.hexes, grid.fixed, detail::GuideView(guide), freedoms, {}, options);
    CHECK_FALSE(guided.concurrent(patches[0]));
    const double worst = guided.quality(0);
    detail::WorstFirst first(guided, grid.hexes.size(), finder, {});
    CHECK(first.run() > 0);
    CHECK(*std::min_element(first.quality().begin(), first.quality().end()) > worst + 0.1);
    CHECK(grid.nodes[middle][0] == 1.2);
    CHECK((grid.nodes[middle] - Vec3(1.2, 1, 1)).norm() < 0.1);
}

TEST_CASE("a surface is judged by its metric") {
    const Eigen::Matrix2d root = detail::metric_root(4.0, 1.0, 3.0, 1e-12);
    Eigen::Matrix2d metric;
    metric << 4.0, 1.0, 1.0, 3.0;
    CHECK((root.transpose() * root - metric).norm() < 1e-14);
    CHECK(detail::metric_root(0.0, 0.0, 1.0, 0.25).determinant() == Approx(0.5));

    auto grid = quad_grid(2, 2);
    grid.nodes[4] = {2.5, 1};
    const UntangleOptions options;
    const Plane plane;
    detail::SurfaceModel model(plane, grid.nodes, grid.quads, grid.fixed, {}, options);
    CHECK(detail::is_inverted(model.quality(1)));
    CHECK_FALSE(model.hopeless(1));
    detail::PatchFinder<2> finder(grid.quads, grid.fixed);
    const auto patches = finder.find(std::vector<Index>{0}, 1);
    CHECK(model.solve(patches.at(0), 0.9, sequential) > 0);
    CHECK((grid.nodes[4] - Vec2(1, 1)).norm() < 0.1);
    for (Index q = 0; q < 4; ++q) {
        CHECK(model.quality(q) > 0.9);
    }
}

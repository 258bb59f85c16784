#include <pavior/smooth/lbfgs.hpp>

#include "support/catch.hpp"

#include <Eigen/Core>

#include <cmath>
#include <limits>

using namespace pavior;

namespace {

double rosenbrock(const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    double f = 0.0;
    g.setZero(x.size());
    for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
        const double a = x[i + 1] - x[i] * x[i];
        const double b = 1.0 - x[i];
        f += 100.0 * a * a + b * b;
        g[i] += -400.0 * a * x[i] - 2.0 * b;
        g[i + 1] += 200.0 * a;
    }
    return f;
}

}  // namespace

TEST_CASE("L-BFGS finds the minimum of Rosenbrock's function", "[lbfgs]") {
    Lbfgs lbfgs;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(10, -0.5);
    const LbfgsResult result = lbfgs.minimise(x, rosenbrock, {2000, 1e-16, 1e-9});
    CHECK((x - Eigen::VectorXd::Ones(10)).norm() < 1e-6);
    CHECK(result.value < 1e-12);
    CHECK(result.iterations < 300);
}

TEST_CASE("L-BFGS: a quadratic with its own diagonal takes a step or two", "[lbfgs]") {
    Lbfgs lbfgs;
    Eigen::VectorXd scale(4);
    scale << 1.0, 1e3, 1e6, 1e9;
    Eigen::VectorXd x = Eigen::VectorXd::Ones(4);
    const auto f = [&](const Eigen::VectorXd& at, Eigen::VectorXd& g) {
        g = scale.cwiseProduct(at);
        return 0.5 * at.dot(g);
    };
    const LbfgsResult result = lbfgs.minimise(x, f, {50, 0.0, 1e-8}, scale);
    CHECK(result.iterations <= 2);
    CHECK(x.norm() < 1e-12);
}

TEST_CASE("L-BFGS never leaves the domain where the function is finite", "[lbfgs]") {
    Lbfgs lbfgs;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(3, 5.0);
    const auto f = [](const Eigen::VectorXd& at, Eigen::VectorXd& g) {
        g.setZero(at.size());
        if (!(at.minCoeff() > 0.0)) {
            return std::numeric_limits<double>::infinity();
        }
        g = (1.0 - 1e-3 * at.array().inverse()).matrix();
        return at.sum() - 1e-3 * at.array().log().sum();
    };
    lbfgs.minimise(x, f, {500, 1e-15, 1e-8});
    CHECK(x.minCoeff() > 0.0);
    CHECK((x.array() - 1e-3).abs().maxCoeff() < 1e-5);
}

TEST_CASE("L-BFGS does not raise the value, and stays where nothing can be gained", "[lbfgs]") {
    Lbfgs lbfgs;
    Eigen::VectorXd x(2);
    x << -1.2, 1.0;
    Eigen::VectorXd g(2);
    double value = rosenbrock(x, g);
    for (int k = 0; k < 20; ++k) {
        const LbfgsResult result = lbfgs.minimise(x, rosenbrock, {1, 0.0, 0.0});
        CHECK(result.value <= value);
        CHECK(result.value == rosenbrock(x, g));
        value = result.value;
    }
    Eigen::VectorXd still = Eigen::VectorXd::Ones(2);
    CHECK(lbfgs.minimise(still, rosenbrock).iterations == 0);
    CHECK(still == Eigen::VectorXd::Ones(2));
    Eigen::VectorXd none;
    CHECK(lbfgs.minimise(none, [](const Eigen::VectorXd&, Eigen::VectorXd&) { return 3.0; }).value == 3.0);
}

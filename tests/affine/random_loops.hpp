#pragma once
// Random point sets and loops with fixed seeds, in two to four dimensions, and reading of the case files.

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace test {

using Offsets = std::vector<std::size_t>;

template <int N>
using Points = Eigen::Matrix<double, N, Eigen::Dynamic>;

/// Calls check(std::integral_constant<int, n>, seed) for n = 2, 3, 4 and each seed.
template <class Check>
void for_dimensions_and_seeds(int seeds, const Check& check) {
    for (int seed = 1; seed <= seeds; ++seed) {
        check(std::integral_constant<int, 2>(), seed);
        check(std::integral_constant<int, 3>(), seed);
        check(std::integral_constant<int, 4>(), seed);
    }
}

class Random {
public:
    explicit Random(int seed) : engine_(static_cast<std::mt19937_64::result_type>(seed) * 7919U) {}

    /// Uniform in [-1, 1].
    double number() { return 2 * static_cast<double>(engine_() >> 11U) / 9007199254740992.0 - 1; }

    template <int R, int C>
    Eigen::Matrix<double, R, C> matrix(Eigen::Index rows = R, Eigen::Index cols = C) {
        return Eigen::Matrix<double, R, C>::NullaryExpr(rows, cols, [this] { return number(); });
    }
    template <int N>
    Eigen::Matrix<double, N, 1> vector() {
        return matrix<N, 1>();
    }
    template <int N>
    Eigen::Matrix<double, N, 1> unit();
    /// Orthogonal matrix with determinant \p sign.
    template <int N>
    Eigen::Matrix<double, N, N> orthogonal(int sign = 1);
    /// A linear map with singular values in [0.5, 2] and positive determinant.
    template <int N>
    Eigen::Matrix<double, N, N> linear();
    /// m points that span R^N.
    template <int N>
    Points<N> points(Eigen::Index m);
    /// m points in the hyperplane through \p centre with unit normal \p normal.
    template <int N>
    Points<N> hyperplanar(Eigen::Index m, const Eigen::Matrix<double, N, 1>& normal,
                          const Eigen::Matrix<double, N, 1>& centre);
    /// A star-shaped closed loop of m points about the z axis, counter-clockwise, with heights up to \p height.
    Points<3> loop(Eigen::Index m, double height, double radius = 1);
    /// An outer loop of m points and a hole of m / 2, clockwise; see offsets(m).
    Points<3> multi_loop(Eigen::Index m, double height);
    static Offsets offsets(Eigen::Index m) {
        return {0, static_cast<std::size_t>(m), static_cast<std::size_t>(m + m / 2)};
    }

private:
    std::mt19937_64 engine_;
};

template <int N>
Offsets one_loop(const Points<N>& X) {
    return {0, static_cast<std::size_t>(X.cols())};
}

nlohmann::json read_case(const std::string& name);

Points<3> to_points(const nlohmann::json& rows);

/// X of least |M X - B|, of smallest norm where singular values below 1e-8 are zero; by orthogonal decompositions.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B);

}  // namespace test

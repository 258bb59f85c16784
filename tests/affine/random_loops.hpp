#pragma once
// Random point sets and loops with fixed seeds, and reading of the case files.

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <random>
#include <stdexcept>
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
    Eigen::Matrix<double, N, 1> unit() {
        Eigen::Matrix<double, N, 1> v = vector<N>();
        while (v.norm() < 0.3) {
            v = vector<N>();
        }
        return v.normalized();
    }
    /// Orthogonal matrix with determinant \p sign.
    template <int N>
    Eigen::Matrix<double, N, N> orthogonal(int sign = 1) {
        Eigen::Matrix<double, N, N> Q = matrix<N, N>().householderQr().householderQ();
        if (Q.determinant() * sign < 0) {
            Q.col(0) *= -1;
        }
        return Q;
    }
    /// A linear map with singular values in [0.5, 2] and positive determinant.
    template <int N>
    Eigen::Matrix<double, N, N> linear() {
        Eigen::Matrix<double, N, 1> w;
        for (int i = 0; i < N; ++i) {
            w(i) = std::pow(2.0, number());
        }
        return orthogonal<N>() * w.asDiagonal() * orthogonal<N>();
    }
    /// m points that span R^N.
    template <int N>
    Points<N> points(Eigen::Index m) {
        return matrix<N, Eigen::Dynamic>(N, m);
    }
    /// m points in the hyperplane through \p centre with unit normal \p normal.
    template <int N>
    Points<N> hyperplanar(Eigen::Index m, const Eigen::Matrix<double, N, 1>& normal,
                          const Eigen::Matrix<double, N, 1>& centre) {
        const Points<N> raw = points<N>(m);
        return (raw - normal * (normal.transpose() * raw)).colwise() + centre;
    }
    /// A star-shaped closed loop of m points about the z axis, counter-clockwise, with heights up to \p height.
    Points<3> loop(Eigen::Index m, double height, double radius = 1) {
        const double phase = number();
        Points<3> X(3, m);
        for (Eigen::Index i = 0; i < m; ++i) {
            const double t = 2 * M_PI * (static_cast<double>(i) + 0.3 * number()) / static_cast<double>(m);
            const double r = radius * (1 + 0.2 * std::cos(3 * t + phase) + 0.05 * number());
            X.col(i) << r * std::cos(t), r * std::sin(t), height * (std::cos(2 * t + phase) + 0.2 * number());
        }
        return X;
    }
    /// An outer loop of m points and a hole of m / 2, clockwise; see offsets(m).
    Points<3> multi_loop(Eigen::Index m, double height) {
        Points<3> X(3, m + m / 2);
        X.leftCols(m) = loop(m, height);
        X.rightCols(m / 2) = loop(m / 2, height, 0.3).rowwise().reverse();
        X.rightCols(m / 2).row(0).array() += 0.2;
        return X;
    }
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

inline nlohmann::json read_case(const std::string& name) {
    nlohmann::json data;
    std::string path = PAVIOR_TEST_DATA;
    path += "/sweep/";
    path += name;
    path += ".json";
    std::ifstream file(path);
    if (!file) {
        throw std::runtime_error("no case file " + name);
    }
    file >> data;
    return data;
}

inline Points<3> to_points(const nlohmann::json& rows) {
    Points<3> X(3, static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            X(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = rows[i][k].get<double>();
        }
    }
    return X;
}

}  // namespace test

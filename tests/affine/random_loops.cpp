#include "affine/random_loops.hpp"

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace test {

namespace {

/// Q of M = Q R by Householder reflections.
Eigen::MatrixXd orthogonal_factor(Eigen::MatrixXd M) {
    const Eigen::Index n = M.rows();
    Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
        Eigen::VectorXd v = Eigen::VectorXd::Zero(n);
        double square = 0;
        for (Eigen::Index i = k; i < n; ++i) {
            v(i) = M(i, k);
            square += v(i) * v(i);
        }
        v(k) += v(k) < 0 ? -std::sqrt(square) : std::sqrt(square);
        const double length = v.squaredNorm();
        for (Eigen::Index j = 0; j < n; ++j) {
            double along_M = 0;
            double along_Q = 0;
            for (Eigen::Index i = k; i < n; ++i) {
                along_M += 2 * v(i) * M(i, j) / length;
                along_Q += 2 * Q(j, i) * v(i) / length;
            }
            for (Eigen::Index i = k; i < n; ++i) {
                M(i, j) -= along_M * v(i);
                Q(j, i) -= along_Q * v(i);
            }
        }
    }
    return Q;
}

}  // namespace

template <int N>
Eigen::Matrix<double, N, 1> Random::unit() {
    Eigen::Matrix<double, N, 1> v = vector<N>();
    while (v.norm() < 0.3) {
        v = vector<N>();
    }
    return v.normalized();
}

template <int N>
Eigen::Matrix<double, N, N> Random::orthogonal(int sign) {
    Eigen::Matrix<double, N, N> Q = orthogonal_factor(matrix<N, N>());
    if (Q.determinant() * sign < 0) {
        Q.col(0) *= -1;
    }
    return Q;
}

template <int N>
Eigen::Matrix<double, N, N> Random::linear() {
    Eigen::Matrix<double, N, 1> w;
    for (int i = 0; i < N; ++i) {
        w(i) = std::pow(2.0, number());
    }
    return orthogonal<N>() * w.asDiagonal() * orthogonal<N>();
}

template <int N>
Points<N> Random::points(Eigen::Index m) {
    return matrix<N, Eigen::Dynamic>(N, m);
}

template <int N>
Points<N> Random::hyperplanar(Eigen::Index m, const Eigen::Matrix<double, N, 1>& normal,
                              const Eigen::Matrix<double, N, 1>& centre) {
    const Points<N> raw = points<N>(m);
    return (raw - normal * (normal.transpose() * raw)).colwise() + centre;
}

#define TEST_RANDOM(N)                                                                          \
    template Eigen::Matrix<double, N, 1> Random::unit<N>();                                     \
    template Eigen::Matrix<double, N, N> Random::orthogonal<N>(int);                            \
    template Eigen::Matrix<double, N, N> Random::linear<N>();                                   \
    template Points<N> Random::points<N>(Eigen::Index);                                         \
    template Points<N> Random::hyperplanar<N>(Eigen::Index, const Eigen::Matrix<double, N, 1>&, \
                                              const Eigen::Matrix<double, N, 1>&);
TEST_RANDOM(2)
TEST_RANDOM(3)
TEST_RANDOM(4)

Points<3> Random::loop(Eigen::Index m, double height, double radius) {
    const double phase = number();
    Points<3> X(3, m);
    for (Eigen::Index i = 0; i < m; ++i) {
        const double t = 2 * M_PI * (static_cast<double>(i) + 0.3 * number()) / static_cast<double>(m);
        const double r = radius * (1 + 0.2 * std::cos(3 * t + phase) + 0.05 * number());
        X.col(i) << r * std::cos(t), r * std::sin(t), height * (std::cos(2 * t + phase) + 0.2 * number());
    }
    return X;
}

Points<3> Random::multi_loop(Eigen::Index m, double height) {
    Points<3> X(3, m + m / 2);
    X.leftCols(m) = loop(m, height);
    X.rightCols(m / 2) = loop(m / 2, height, 0.3).rowwise().reverse();
    X.rightCols(m / 2).row(0).array() += 0.2;
    return X;
}

nlohmann::json read_case(const std::string& name) {
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

Points<3> to_points(const nlohmann::json& rows) {
    Points<3> X(3, static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            X(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = rows[i][k].get<double>();
        }
    }
    return X;
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(1e-8);
    decomposition.compute(M);
    return decomposition.solve(B);
}

}  // namespace test

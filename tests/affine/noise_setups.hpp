#pragma once
// Loops of radius 1 with offset height 0.25 whose points are disturbed by noise eps, and how far a map moves nodes.

#include "affine/random_loops.hpp"

#include <pavior/affine/fit.hpp>

#include <algorithm>

namespace test {

/// A planar loop X, a planar Y that is a distorted image of it, and nodes inside at heights up to 0.25.
struct NoiseSetup {
    Points<3> X;
    Points<3> Y;
    Points<3> nodes;
    Offsets offsets;

    /// \p misfit: in-plane difference between Y and the best affine image of X
    NoiseSetup(Random& random, double misfit) : X(random.loop(24, 0)), Y(X), nodes(3, 40), offsets(one_loop<3>(X)) {
        Y.row(0) *= 1.2;
        Y.topRows(2) += misfit * random.points<2>(24);
        Y.row(2).array() += 1;
        for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
            nodes.col(j) << 0.6 * random.number(), 0.6 * random.number(), 0.25 * random.number();
        }
    }

    /// Furthest that a node moves when X is replaced by \p noisy_X and Y by \p noisy_Y.
    double movement(pavior::AffineMethod method, const Points<3>& noisy_X, const Points<3>& noisy_Y) const {
        const auto clean = pavior::fit_affine(method, X, Y, offsets);
        const auto noisy = pavior::fit_affine(method, noisy_X, noisy_Y, offsets);
        if (clean.status != pavior::FitStatus::ok || noisy.status != pavior::FitStatus::ok) {
            return 1e300;
        }
        double worst = 0;
        for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
            worst = std::max(worst, (clean.map(nodes.col(j)) - noisy.map(nodes.col(j))).norm());
        }
        return worst;
    }

    enum class Noise {
        off_the_source_plane,  ///< X leaves its plane
        cad_like,              ///< X leaves its plane, Y moves in its own
        everywhere,            ///< all coordinates of X and Y
    };

    double movement(pavior::AffineMethod method, Random& random, Noise kind, double eps) const {
        Points<3> on_X = eps * random.points<3>(X.cols());
        Points<3> on_Y = eps * random.points<3>(X.cols());
        if (kind != Noise::everywhere) {
            on_X.topRows(2).setZero();
            on_Y.row(2).setZero();
        }
        if (kind == Noise::off_the_source_plane) {
            on_Y.setZero();
        }
        return movement(method, X + on_X, Y + on_Y);
    }
};

/// Worst movement over 20 patterns.
inline double worst_movement(pavior::AffineMethod method, NoiseSetup::Noise kind, double misfit, double eps) {
    double worst = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const NoiseSetup setup(random, misfit);
        worst = std::max(worst, setup.movement(method, random, kind, eps));
    }
    return worst;
}

}  // namespace test

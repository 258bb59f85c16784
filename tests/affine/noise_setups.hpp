#pragma once
// Loops of radius 1 with offset height 0.25 whose points are disturbed by noise eps, and how far a map moves nodes.

#include "affine/random_loops.hpp"

#include <pavior/affine/fit.hpp>

namespace test {

/// A planar loop X, a planar Y that is a distorted image of it, and nodes inside at heights up to 0.25.
struct NoiseSetup {
    Points<3> X;
    Points<3> Y;
    Points<3> nodes;
    Offsets offsets;

    /// \p misfit: in-plane difference between Y and the best affine image of X
    NoiseSetup(Random& random, double misfit);

    /// Furthest that a node moves when X is replaced by \p noisy_X and Y by \p noisy_Y.
    double movement(pavior::AffineMethod method, const Points<3>& noisy_X, const Points<3>& noisy_Y) const;

    enum class Noise {
        off_the_source_plane,  ///< X leaves its plane
        cad_like,              ///< X leaves its plane, Y moves in its own
        everywhere,            ///< all coordinates of X and Y
    };

    double movement(pavior::AffineMethod method, Random& random, Noise kind, double eps) const;
};

/// Worst movement over 20 patterns.
double worst_movement(pavior::AffineMethod method, NoiseSetup::Noise kind, double misfit, double eps);

}  // namespace test

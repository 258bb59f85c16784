#include "affine/noise_setups.hpp"

#include <algorithm>

namespace test {

NoiseSetup::NoiseSetup(Random& random, double misfit)
    : X(random.loop(24, 0)), Y(X), nodes(3, 40), offsets(one_loop<3>(X)) {
    Y.row(0) *= 1.2;
    Y.topRows(2) += misfit * random.points<2>(24);
    Y.row(2).array() += 1;
    for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
        nodes.col(j) << 0.6 * random.number(), 0.6 * random.number(), 0.25 * random.number();
    }
}

double NoiseSetup::movement(pavior::AffineMethod method, const Points<3>& noisy_X, const Points<3>& noisy_Y) const {
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

double NoiseSetup::movement(pavior::AffineMethod method, Random& random, Noise kind, double eps) const {
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

double worst_movement(pavior::AffineMethod method, NoiseSetup::Noise kind, double misfit, double eps) {
    double worst = 0;
    for (int seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const NoiseSetup setup(random, misfit);
        worst = std::max(worst, setup.movement(method, random, kind, eps));
    }
    return worst;
}

}  // namespace test

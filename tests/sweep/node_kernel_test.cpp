#include "support/catch.hpp"

#include <pavior/sweep/node_kernel.hpp>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

using namespace pavior;

namespace {

std::vector<InstructionSet> available() {
    std::vector<InstructionSet> sets;
    for (int s = 0; s <= static_cast<int>(best_instruction_set()); ++s) {
        sets.push_back(static_cast<InstructionSet>(s));
    }
    return sets;
}

std::vector<double> random_values(std::size_t count, unsigned seed, double low = -1, double high = 1) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> value(low, high);
    std::vector<double> values(count);
    for (double& x : values) {
        x = value(generator);
    }
    return values;
}

LevelOperator random_operator(unsigned seed) {
    const std::vector<double> values = random_values(21, seed);
    LevelOperator level;
    for (std::size_t c = 0; c < 3; ++c) {
        level.centre[c] = values[c];
        for (std::size_t s = 0; s < 6; ++s) {
            level.linear[s][c] = values[3 + 3 * s + c];
        }
    }
    return level;
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("positions are the operator applied from left to right by fused multiply-adds") {
    const std::size_t n = 5;
    const std::vector<double> caps = random_values(6 * n, 1);
    CapCoordinates rows;
    for (std::size_t s = 0; s < 6; ++s) {
        rows.row[s] = caps.data() + s * n;
    }
    const LevelOperator level = random_operator(2);
    std::vector<double> out(3 * n);
    apply_level(level, rows, nullptr, 0, 0, n, out.data());
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = level.centre[c];
            for (std::size_t s = 0; s < 6; ++s) {
                sum = std::fma(level.linear[s][c], rows.row[s][i], sum);
            }
            CHECK(out[3 * i + c] == sum);
        }
    }
}

TEST_CASE("all instruction sets give the same bits, for any range, alignment, correction and way to store") {
    const std::size_t n = 203;
    const std::vector<double> caps = random_values(6 * n, 3);
    const std::vector<double> correction = random_values(3 * n, 4);
    CapCoordinates rows;
    for (std::size_t s = 0; s < 6; ++s) {
        rows.row[s] = caps.data() + s * n;
    }
    const LevelOperator level = random_operator(5);
    for (const InstructionSet set : available()) {
        for (const bool stream : {false, true}) {
            for (const double* add : {static_cast<const double*>(nullptr), correction.data()}) {
                for (std::size_t begin : {0U, 1U, 16U}) {
                    for (std::size_t end : {std::size_t{16}, std::size_t{19}, std::size_t{24}, n}) {
                        for (std::size_t shift = 0; shift < 8; ++shift) {
                            std::vector<double> want(3 * n + 8, 7.0);
                            std::vector<double> got = want;
                            detail::apply_level_scalar(level, rows, add, n, begin, end, want.data() + shift);
                            apply_level(level, rows, add, n, begin, end, got.data() + shift, {set, stream});
                            finish_streaming();
                            REQUIRE(same_bytes(want, got));
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("weights and weighted residuals have the same bits for all instruction sets") {
    constexpr std::size_t tile = detail::weight_tile;
    constexpr std::size_t strip = detail::strip_columns;
    for (const std::size_t m : {1U, 2U, 37U}) {
        const std::vector<double> node = random_values(3 * tile, 6);
        std::vector<double> loop = random_values(3 * m, 7);
        for (std::size_t c = 0; c < 3; ++c) {
            loop[c * m] = node[c * tile + 3];  // node 3 lies on loop point 0
        }
        const double* at[3] = {node.data(), node.data() + tile, node.data() + 2 * tile};
        const double* from[3] = {loop.data(), loop.data() + m, loop.data() + 2 * m};
        const std::vector<double> residuals = random_values(m * strip, 8);
        std::vector<double> weights(m * tile);
        std::vector<double> sums(tile);
        std::vector<double> field(strip * tile, 0.5);
        detail::inverse_square_weights_scalar(at, from, m, weights.data(), sums.data());
        detail::weighted_residuals_scalar(weights.data(), sums.data(), residuals.data(), m, field.data(), tile);
        for (std::size_t c = 0; c < strip; ++c) {
            CHECK(field[c * tile + 3] == Approx(0.5 + residuals[c]).epsilon(1e-15));
        }
        for (const InstructionSet set : available()) {
            std::vector<double> w(m * tile);
            std::vector<double> s(tile);
            std::vector<double> f(strip * tile, 0.5);
            detail::inverse_square_weights(set, at, from, m, w.data(), s.data());
            detail::weighted_residuals(set, w.data(), s.data(), residuals.data(), m, f.data(), tile);
            CHECK(same_bytes(w, weights));
            CHECK(same_bytes(s, sums));
            CHECK(same_bytes(f, field));
        }
    }
}

TEST_CASE("the best instruction set is one that this machine has") {
#if defined(__x86_64__)
    CHECK(best_instruction_set() >= InstructionSet::sse2);
#else
    CHECK(best_instruction_set() == InstructionSet::scalar);
#endif
}

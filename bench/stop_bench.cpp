// How soon a call ends that another thread asks to stop: block_solid() with marking, refinement and optimisation, asked
// at moments spread evenly over its run.
#include "timing.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/dual/features.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <stop_token>
#include <thread>
#include <vector>

using namespace pavior;

namespace {

// A block of n^3 boxes, six tetrahedra each, without one of its corners: three re-entrant curves.
// Bent, its sheets end in rounds of repair.
ReferenceMesh corner_piece(Index n, double bend) {
    const auto at = [n](Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; };
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    TetMesh mesh;
    std::vector<Index> id((n + 1) * (n + 1) * (n + 1), no_index);
    const auto node = [&](const std::array<Index, 3>& x) {
        Index& i = id[at(x[0], x[1], x[2])];
        if (i == no_index) {
            i = static_cast<Index>(mesh.nodes.size());
            const Vec3 p = Vec3(x[0], x[1], x[2]) / n;
            mesh.nodes.emplace_back(p[0], p[1] * (1 + bend * p[0]), p[2] * (1 + bend * p[1]));
        }
        return i;
    };
    for (Index box = 0; box < n * n * n; ++box) {
        const std::array<Index, 3> low{box % n, box / n % n, box / n / n};
        if (2 * low[0] >= n && 2 * low[1] >= n && 2 * low[2] >= n) {
            continue;
        }
        for (std::size_t o = 0; o < 6; ++o) {
            std::array<Index, 3> x = low;
            TetCorners c{node(x), 0, 0, 0};
            for (std::size_t s = 0; s < 3; ++s) {
                ++x[orders[o][s]];
                c[s + 1] = node(x);
            }
            if (o >= 3) {
                std::swap(c[2], c[3]);
            }
            mesh.tets.push_back(c);
        }
    }
    return make_reference_mesh(mesh);
}

void stop_block_solid(benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    const ReferenceMesh mesh =
        corner_piece(static_cast<Index>(state.range(0)), 0.01 * static_cast<double>(state.range(3)));
    BlockOptions options;
    options.refine.emplace();
    options.refine->size = 1.0 / static_cast<double>(state.range(1));
    options.refine->optimise = state.range(2) != 0;
    SolidBlocks whole;
    const double all = seconds([&] { whole = block_solid(mesh, options); });
    std::vector<double> latency;
    constexpr int requests = 200;
    for (auto _ : state) {
        for (int k = 0; k < requests; ++k) {
            std::stop_source source;
            options.execution.stop = source.get_token();
            Clock::time_point asked;
            std::jthread other([&] {
                std::this_thread::sleep_for(std::chrono::duration<double>((k + 0.5) / requests * all));
                asked = Clock::now();
                source.request_stop();
            });
            try {
                static_cast<void>(block_solid(mesh, options));
            } catch (const Stopped&) {
                const Clock::time_point now = Clock::now();
                other.join();
                latency.push_back(std::chrono::duration<double>(now - asked).count());
            }
        }
    }
    std::sort(latency.begin(), latency.end());
    state.counters["tets"] = static_cast<double>(mesh.tets.size());
    state.counters["hexes"] = static_cast<double>(whole.fine ? whole.fine->mesh.hexes.size() : 0);
    state.counters["seconds"] = all;
    state.counters["stopped"] = static_cast<double>(latency.size());
    if (!latency.empty()) {
        state.counters["ms_median"] = 1e3 * latency[latency.size() / 2];
        state.counters["ms_99_percent"] = 1e3 * latency[latency.size() * 99 / 100];
        state.counters["ms_worst"] = 1e3 * latency.back();
        state.counters["percent_in_50ms"] =
            100.0 *
            static_cast<double>(std::count_if(latency.begin(), latency.end(), [](double s) { return s <= 0.05; })) /
            static_cast<double>(latency.size());
    }
}
// boxes along an edge, hexahedra along an edge, optimise, bend in per cent
BENCHMARK(stop_block_solid)
    ->Args({8, 20, 1, 0})
    ->Args({24, 100, 0, 0})
    ->Args({6, 16, 1, 20})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace

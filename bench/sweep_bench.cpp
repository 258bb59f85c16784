// Costs of a sweep: (a) the node kernel against a non-temporal write of the same bytes, (b) a foreign mesh against raw
// arrays, (d) one thread against two, and the boundary corrections. Each ratio is measured in one run, the two sides in
// turn, and printed as a counter.
#include "timing.hpp"

#include <pavior/mesh/eigen_access.hpp>
#include <pavior/sweep/sweep.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

using namespace pavior;

namespace {

// Writes count doubles past the caches, as wide as the machine can.
#if defined(__x86_64__)
__attribute__((target("avx512f"))) void fill_avx512(double* to, std::size_t count) {
    const __m512d value = _mm512_set1_pd(1.5);
    for (std::size_t i = 0; i + 8 <= count; i += 8) {
        _mm512_stream_pd(to + i, value);
    }
    _mm_sfence();
}
void fill_sse2(double* to, std::size_t count) {
    const __m128d value = _mm_set1_pd(1.5);
    for (std::size_t i = 0; i + 2 <= count; i += 2) {
        _mm_stream_pd(to + i, value);
    }
    _mm_sfence();
}
void fill(double* to, std::size_t count) {
    best_instruction_set() == InstructionSet::avx512 ? fill_avx512(to, count) : fill_sse2(to, count);
}
#else
void fill(double* to, std::size_t count) { std::fill_n(to, count, 1.5); }
#endif

// cells x cells quads swept through `layers` layers; curved sections that are not affine images if `warp`.
SweepProblem grid(Index cells, std::size_t layers, bool warp) {
    const auto place = [=](double x, double y, double t) {
        const double bend = warp ? 0.2 * t : 0.0;
        return Vec3(x + bend * x * y + 0.3 * t, y + bend * (1 - x * x), 2.5 * t + 0.5 * bend * x * x);
    };
    SweepProblem problem;
    problem.layers = layers;
    for (Index j = 0; j <= cells; ++j) {
        for (Index i = 0; i <= cells; ++i) {
            const double x = 2.0 * i / cells - 1.0;
            const double y = 2.0 * j / cells - 1.0;
            problem.source_nodes.push_back(place(x, y, 0));
            problem.target_nodes.push_back(place(x, y, 1));
            if (i < cells && j < cells) {
                const Index a = j * (cells + 1) + i;
                problem.quads.push_back({a, a + 1, a + cells + 2, a + cells + 1});
            }
        }
    }
    problem.loops = boundary_loops(QuadMeshView<>{problem.source_nodes, problem.quads});
    for (std::size_t k = 0; k <= layers; ++k) {
        for (const Index i : problem.loops.nodes) {
            const double x = 2.0 * (i % (cells + 1)) / cells - 1.0;
            const double y = 2.0 * (i / (cells + 1)) / cells - 1.0;
            problem.boundary_levels.push_back(place(x, y, static_cast<double>(k) / static_cast<double>(layers)));
        }
    }
    return problem;
}

// (a) 100,000 inner nodes, 200 layers: 199 levels of 2.4 MB.
void node_kernel(benchmark::State& state) {
    constexpr std::size_t n = 100000;
    constexpr std::size_t levels = 199;
    std::vector<Vec3> cap(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double s = static_cast<double>(i);
        cap[i] = Vec3(std::sin(s), std::cos(1.3 * s), std::sin(0.7 * s));
    }
    const detail::CapArray caps(cap, cap, Vec3(0, 0, 0), Vec3(1, 2, 3));
    std::vector<LevelOperator> operators(levels);
    for (std::size_t k = 0; k < levels; ++k) {
        for (std::size_t s = 0; s < 6; ++s) {
            for (std::size_t c = 0; c < 3; ++c) {
                operators[k].linear[s][c] = 0.01 * static_cast<double>(k + s) - 0.1 * static_cast<double>(c);
            }
        }
    }
    std::vector<double> out(3 * n * levels + 8);
    std::fill(out.begin(), out.end(), 0.0);  // warm
    double* first = out.data();
    while (reinterpret_cast<std::uintptr_t>(first) % 64 != 0) {
        ++first;
    }
    KernelOptions options;
    options.instructions = static_cast<InstructionSet>(state.range(0));
    options.stream = true;
    if (options.instructions > best_instruction_set()) {
        state.SkipWithError("not on this machine");
        return;
    }
    double raw = std::numeric_limits<double>::infinity();
    double kernel = raw;
    for (auto _ : state) {
        raw = std::min(raw, thread_seconds([&] { fill(first, 3 * n * levels); }));
        kernel = std::min(kernel, thread_seconds([&] {
                              constexpr std::size_t block = 1024;
                              for (std::size_t i = 0; i < n; i += block) {
                                  for (std::size_t k = 0; k < levels; ++k) {
                                      apply_level(operators[k], caps.rows(), nullptr, 0, i, std::min(n, i + block),
                                                  first + 3 * (k * n + i), options);
                                  }
                              }
                              finish_streaming();
                          }));
    }
    const double bytes = static_cast<double>(n * levels * sizeof(Vec3));
    state.counters["raw_GB/s"] = bytes / raw * 1e-9;
    state.counters["kernel_GB/s"] = bytes / kernel * 1e-9;
    state.counters["of_raw_write"] = raw / kernel;
}
BENCHMARK(node_kernel)->ArgName("instructions")->Arg(3)->Arg(2)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

// The same through InnerLayers, with caps and boundary nodes.
void all_levels(benchmark::State& state) {
    const PreparedSweep prepared = prepare_sweep(grid(316, 200, false));
    const InnerLayers& layers = prepared.layers;
    std::vector<Vec3> nodes(layers.level_count() * layers.level_size());
    layers.all_levels(nodes);
    double raw = std::numeric_limits<double>::infinity();
    double processor_time = raw;
    double one = raw;
    double two = raw;
    double* first = nodes.front().data();
    while (reinterpret_cast<std::uintptr_t>(first) % 64 != 0) {
        ++first;
    }
    for (auto _ : state) {
        raw = std::min(raw, thread_seconds([&] { fill(first, 3 * nodes.size() - 8); }));
        processor_time = std::min(processor_time, thread_seconds([&] { layers.all_levels(nodes, {1}); }));
        one = std::min(one, seconds([&] { layers.all_levels(nodes, {1}); }));
        two = std::min(two, seconds([&] { layers.all_levels(nodes, {2}); }));
    }
    state.counters["of_raw_write"] = raw / processor_time;
    state.counters["speedup_2_threads"] = one / two;
    state.counters["nodes/s"] = static_cast<double>(nodes.size()) / one;
}
BENCHMARK(all_levels)->Unit(benchmark::kMillisecond);

// (b) V and F matrices through mesh_access against arrays, verification and all.
void foreign_mesh(benchmark::State& state) {
    const SweepProblem problem = grid(200, 100, false);
    Eigen::MatrixXd V(static_cast<Eigen::Index>(problem.source_nodes.size()), 3);
    Eigen::MatrixXd T(V.rows(), 3);
    Eigen::MatrixXi F(static_cast<Eigen::Index>(problem.quads.size()), 4);
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        V.row(i) = problem.source_nodes[static_cast<std::size_t>(i)].transpose();
        T.row(i) = problem.target_nodes[static_cast<std::size_t>(i)].transpose();
    }
    for (Eigen::Index q = 0; q < F.rows(); ++q) {
        for (Eigen::Index c = 0; c < 4; ++c) {
            F(q, c) = static_cast<int>(problem.quads[static_cast<std::size_t>(q)][static_cast<std::size_t>(c)]);
        }
    }
    const LevelArray<> levels{problem.boundary_levels, problem.loops.nodes.size()};
    const QuadMeshView<> arrays{problem.source_nodes, problem.quads};
    double raw = std::numeric_limits<double>::infinity();
    double foreign = raw;
    for (auto _ : state) {
        raw = std::min(raw, thread_seconds([&] {
                           benchmark::DoNotOptimize(
                               sweep(arrays, problem.target_nodes, problem.loops, levels).mesh.nodes().data());
                       }));
        foreign = std::min(
            foreign, thread_seconds([&] {
                benchmark::DoNotOptimize(
                    sweep(EigenQuadMesh{V, F}, EigenQuadMesh{T, F}, problem.loops, levels).mesh.nodes().data());
            }));
    }
    state.counters["of_raw_arrays"] = foreign / raw;
}
BENCHMARK(foreign_mesh)->Unit(benchmark::kMillisecond);

// Boundary correction of 100,000 nodes and 1264 loop nodes, 16 layers; flops of the weighted sums.
void correction(benchmark::State& state) {
    const auto kind = static_cast<BoundaryCorrection>(state.range(0));
    SweepOptions options;
    options.correction = kind;
    const PreparedSweep prepared = prepare_sweep(grid(316, 16, true), options);
    const InnerLayers& layers = prepared.layers;
    std::vector<Vec3> nodes(layers.level_count() * layers.level_size());
    double one = std::numeric_limits<double>::infinity();
    double two = one;
    double processor_time = one;
    for (auto _ : state) {
        processor_time = std::min(processor_time, thread_seconds([&] { layers.all_levels(nodes, {1}); }));
        one = std::min(one, seconds([&] { layers.all_levels(nodes, {1}); }));
        two = std::min(two, seconds([&] { layers.all_levels(nodes, {2}); }));
    }
    const double m = static_cast<double>(layers.problem().loops.nodes.size());
    const double n = static_cast<double>(layers.level_size());
    state.SetLabel(std::string(to_string(kind)));
    state.counters["s/level"] = processor_time / 15;
    state.counters["prepare_s"] = prepared.report.prepare_seconds;
    state.counters["speedup_2_threads"] = one / two;
    if (kind == BoundaryCorrection::idw) {
        state.counters["GFlop/s"] = 2 * 2 * m * n * 45 / processor_time * 1e-9;
    }
}
BENCHMARK(correction)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(2);

}  // namespace

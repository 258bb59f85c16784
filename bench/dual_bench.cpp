// Cost of the local dual contributions against TetGen's own time on the same mesh, from 10^4 to 5 x 10^6 tetrahedra:
// time per tetrahedron of each step, bytes per tetrahedron, one thread against two; and the way to the same blocks by
// the cell complex. A unit cube in eight boxes, the
// cuts given to TetGen as facets.
#include "timing.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/contributions/dual_blocks.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/dual/spatial_order.hpp>

#include <benchmark/benchmark.h>

#if defined(PAVIOR_BENCH_TETGEN)
#include <tetgen.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace pavior;

namespace {

struct Sample {
    TaggedTetMesh mesh;
    double tetgen_seconds = 0.0;
};

#if defined(PAVIOR_BENCH_TETGEN)
// The sides of the eight boxes as TetGen's facets.
void describe(tetgenio& in) {
    in.numberofpoints = 27;
    in.pointlist = new REAL[81];
    for (int i = 0; i < 27; ++i) {
        for (int axis = 0, n = i; axis < 3; ++axis, n /= 3) {
            in.pointlist[3 * i + axis] = 0.5 * (n % 3);
        }
    }
    in.numberoffacets = 36;
    in.facetlist = new tetgenio::facet[36];
    in.facetmarkerlist = new int[36];
    constexpr std::array<int, 3> stride{1, 3, 9};
    int f = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int u = stride[(axis + 1) % 3];
        const int v = stride[(axis + 2) % 3];
        for (int n = 0; n < 12; ++n, ++f) {
            const int corner = n / 4 * stride[axis] + n % 2 * u + n / 2 % 2 * v;
            tetgenio::facet& facet = in.facetlist[f];
            tetgenio::init(&facet);
            facet.numberofpolygons = 1;
            facet.polygonlist = new tetgenio::polygon[1];
            facet.polygonlist->numberofvertices = 4;
            facet.polygonlist->vertexlist = new int[4]{corner, corner + u, corner + u + v, corner + v};
            in.facetmarkerlist[f] = 1 + n / 4;
        }
    }
}

Sample make_sample(std::size_t wanted) {
    tetgenio in;
    tetgenio out;
    describe(in);
    std::array<char, 64> switches{};
    std::snprintf(switches.data(), switches.size(), "pq1.4a%.9gQ", 2.0 / static_cast<double>(wanted));
    Sample sample;
    sample.tetgen_seconds = thread_seconds([&] { tetrahedralize(switches.data(), &in, &out); });
    for (int i = 0; i < out.numberofpoints; ++i) {
        sample.mesh.mesh.nodes.emplace_back(out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]);
    }
    const auto id = [](int i) { return static_cast<Index>(i); };
    for (int t = 0; t < out.numberoftetrahedra; ++t) {
        const int* c = out.tetrahedronlist + 4 * t;
        sample.mesh.mesh.tets.push_back({id(c[0]), id(c[2]), id(c[1]), id(c[3])});  // TetGen's are negative
    }
    for (int f = 0; f < out.numberoftrifaces; ++f) {
        const int* c = out.trifacelist + 3 * f;
        sample.mesh.triangles.push_back({{id(c[0]), id(c[1]), id(c[2])}, out.trifacemarkerlist[f]});
    }
    return sample;
}
#else
// Without TetGen: boxes of six tetrahedra each, in order.
Sample make_sample(std::size_t wanted) {
    Index n = 2;
    while (6 * std::size_t{n} * n * n < wanted) {
        n += 2;
    }
    Sample sample;
    const auto at = [n](Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; };
    for (Index i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
        sample.mesh.mesh.nodes.push_back(Vec3(i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1) / (n + 1)) / n);
    }
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (Index box = 0; box < n * n * n; ++box) {
        for (std::size_t o = 0; o < 6; ++o) {
            std::array<Index, 3> x{box % n, box / n % n, box / n / n};
            TetCorners c{at(x[0], x[1], x[2]), 0, 0, 0};
            for (std::size_t s = 0; s < 3; ++s) {
                ++x[orders[o][s]];
                c[s + 1] = at(x[0], x[1], x[2]);
            }
            if (o >= 3) {
                std::swap(c[2], c[3]);
            }
            sample.mesh.mesh.tets.push_back(c);
        }
    }
    return sample;
}
#endif

// All that the room makes of a mesh.
struct Dual {
    TetTopology topology;
    EntityClasses classes;
    std::vector<TetContributions> contributions;
    Regions regions;
    DualBlocks blocks;
    CellComplex complex;
    BlockMesh published;  // by the contributions
    BlockMesh midpoints;  // by the complex

    [[nodiscard]] bool operator==(const Dual& other) const {
        return topology == other.topology && classes == other.classes && contributions == other.contributions &&
               regions == other.regions && blocks.blocks == other.blocks.blocks &&
               complex.corners == other.complex.corners && complex.tet_cell == other.complex.tet_cell &&
               complex.face_patch == other.complex.face_patch && complex.edge_chain == other.complex.edge_chain;
    }
};

using Times = std::array<double, 8>;

template <class Clock>
Times run(const ReferenceMesh& mesh, Execution execution, const Clock& clock, Dual& dual) {
    return {clock([&] { dual.topology = tet_topology(mesh, execution); }),
            clock([&] { dual.classes = classify(mesh, dual.topology, execution); }),
            clock([&] {
                dual.contributions =
                    add_contributions(mesh, dual.topology, dual.classes, VertexRule::repaired, execution);
            }),
            clock([&] { dual.regions = regions(mesh, dual.topology, dual.contributions, execution); }),
            clock([&] { dual.blocks = dual_blocks(mesh, dual.topology, dual.contributions, dual.regions); }),
            clock([&] { dual.complex = cell_complex(mesh, dual.topology, dual.classes, execution); }),
            clock([&] { dual.published = dualize(mesh, dual.topology, dual.regions, dual.blocks); }),
            clock([&] { dual.midpoints = dualize(mesh, dual.topology, dual.classes, dual.complex); })};
}

template <class T>
double bytes(const std::vector<T>& values) {
    return static_cast<double>(values.size() * sizeof(T));
}

void report(benchmark::State& state, const Sample& sample, const Times& best, const Dual& dual) {
    const double tets = static_cast<double>(sample.mesh.mesh.tets.size());
    const std::array<const char*, 8> names{"topology", "classify", "rules",        "regions",
                                           "dualize",  "complex",  "publish_mesh", "complex_mesh"};
    state.counters["tets"] = tets;
    for (std::size_t i = 0; i < names.size(); ++i) {
        state.counters[std::string("ns_") + names[i]] = best[i] / tets * 1e9;
    }
    const double chapter = best[1] + best[2] + best[3] + best[4];
    state.counters["ns_by_contributions"] = (best[2] + best[3] + best[4] + best[6]) / tets * 1e9;
    state.counters["ns_by_complex"] = (best[5] + best[7]) / tets * 1e9;
    state.counters["ns_all"] = (best[0] + chapter) / tets * 1e9;
    if (sample.tetgen_seconds > 0.0) {
        state.counters["ns_tetgen"] = sample.tetgen_seconds / tets * 1e9;
        state.counters["percent_of_tetgen"] = 100.0 * chapter / sample.tetgen_seconds;
        state.counters["percent_with_topology"] = 100.0 * (best[0] + chapter) / sample.tetgen_seconds;
    }
    const TetTopology& t = dual.topology;
    state.counters["bytes_topology"] =
        (bytes(t.edges) + bytes(t.faces) + bytes(t.tet_edges) + bytes(t.tet_faces) + bytes(t.face_edges) +
         bytes(t.face_tets) + bytes(t.node_rank) + bytes(t.edge_begin) + bytes(t.face_begin)) /
        tets;
    state.counters["bytes_dual"] =
        (bytes(dual.classes.face) + bytes(dual.classes.edge) + bytes(dual.classes.node) + bytes(dual.contributions) +
         bytes(dual.regions.tet) + bytes(dual.regions.face) + bytes(dual.regions.edge) + bytes(dual.regions.node)) /
        tets;
    state.counters["blocks"] = static_cast<double>(dual.blocks.blocks.size());
}

void dual_contributions(benchmark::State& state) {
    const Sample sample = make_sample(static_cast<std::size_t>(state.range(0)));
    ReferenceMesh mesh;
    const double reference = thread_seconds([&] { mesh = make_reference_mesh(sample.mesh); });
    const double sorting = thread_seconds([&] { benchmark::DoNotOptimize(spatial_order(sample.mesh.mesh).data()); });
    Times best{};
    best.fill(std::numeric_limits<double>::infinity());
    double one = best[0];
    double two = best[0];
    bool same = true;
    Dual dual;
    for (auto _ : state) {
        const Times times = run(
            mesh, sequential, [](const auto& work) { return thread_seconds(work); }, dual);
        std::transform(best.begin(), best.end(), times.begin(), best.begin(),
                       [](double a, double b) { return std::min(a, b); });
        Dual parallel_dual;
        const auto wall = [](const auto& work) { return seconds(work); };
        one = std::min(one, seconds([&] { run(mesh, sequential, wall, parallel_dual); }));
        two = std::min(two, seconds([&] { run(mesh, Execution{2}, wall, parallel_dual); }));
        same = same && dual == parallel_dual && dual.published.nodes == dual.midpoints.nodes &&
               dual.published.hexes == dual.midpoints.hexes;
    }
    report(state, sample, best, dual);
    state.counters["ns_sort"] = sorting / static_cast<double>(mesh.tets.size()) * 1e9;
    state.counters["ns_reference_mesh"] = reference / static_cast<double>(mesh.tets.size()) * 1e9;
    state.counters["speedup_2_threads"] = one / two;
    state.counters["same_bytes"] = same ? 1.0 : 0.0;
    if (!same) {
        state.SkipWithError("two threads or the two ways give other bytes");
    }
}
BENCHMARK(dual_contributions)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(5000000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3);

}  // namespace

// Hexahedra a second: a sweep with its connectivity in memory against Gmsh's extrusion of the same quad mesh.
// Only Gmsh's last stage, the volume, is timed; a sweep is timed from arrays to arrays, verification included.
#include "timing.hpp"

#include <benchmark/benchmark.h>

#if __has_include(<gmsh.h>)
#include <pavior/sweep/sweep.hpp>

#include <gmsh.h>

#include <cstddef>
#include <unordered_map>
#include <vector>

using namespace pavior;

namespace {

constexpr double length = 2.0;

// A square of cells x cells quads, extruded through `layers` layers, meshed up to its surfaces.
void make_surfaces(int cells, int layers) {
    gmsh::clear();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("bar");
    const int p[4] = {gmsh::model::geo::addPoint(0, 0, 0), gmsh::model::geo::addPoint(1, 0, 0),
                      gmsh::model::geo::addPoint(1, 1, 0), gmsh::model::geo::addPoint(0, 1, 0)};
    std::vector<int> lines;
    for (int i = 0; i < 4; ++i) {
        lines.push_back(gmsh::model::geo::addLine(p[i], p[(i + 1) % 4]));
        gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), cells + 1);
    }
    const int surface = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(lines)});
    gmsh::model::geo::mesh::setTransfiniteSurface(surface);
    gmsh::model::geo::mesh::setRecombine(2, surface);
    gmsh::vectorpair out;
    gmsh::model::geo::extrude({{2, surface}}, 0, 0, length, out, {layers}, {}, true);
    gmsh::model::geo::synchronize();
    gmsh::model::mesh::generate(2);
}

// The quads of surface 1 as a problem.
SweepProblem problem_of_surface(std::size_t layers) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, 1, true, false);
    QuadMesh source;
    std::unordered_map<std::size_t, Index> id;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (id.emplace(tags[i], static_cast<Index>(source.nodes.size())).second) {
            source.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
        }
    }
    std::vector<std::size_t> elements;
    std::vector<std::size_t> corners;
    gmsh::model::mesh::getElementsByType(3, elements, corners, 1);
    for (std::size_t q = 0; q < elements.size(); ++q) {
        source.quads.push_back(
            {id.at(corners[4 * q]), id.at(corners[4 * q + 1]), id.at(corners[4 * q + 2]), id.at(corners[4 * q + 3])});
    }
    const auto raised = [](Vec3 x, double z) { return Vec3(x[0], x[1], x[2] + z); };
    std::vector<Vec3> target;
    for (const Vec3& x : source.nodes) {
        target.push_back(raised(x, length));
    }
    const Loops loops = boundary_loops(source);
    std::vector<std::vector<Vec3>> levels(layers + 1);
    for (std::size_t k = 0; k <= layers; ++k) {
        for (const Index i : loops.nodes) {
            levels[k].push_back(raised(source.nodes[i], length * static_cast<double>(k) / static_cast<double>(layers)));
        }
    }
    return make_sweep_problem(source, target, loops, levels);
}

std::size_t hexahedra_of_gmsh() {
    std::vector<std::size_t> elements;
    std::vector<std::size_t> corners;
    gmsh::model::mesh::getElementsByType(5, elements, corners);
    return elements.size();
}

void gmsh_extrusion(benchmark::State& state) {
    const int cells = static_cast<int>(state.range(0));
    const int layers = static_cast<int>(state.range(1));
    gmsh::initialize();
    double extrusion = 1e300;
    double swept = 1e300;
    std::size_t hexahedra = 0;
    for (auto _ : state) {
        make_surfaces(cells, layers);
        const SweepProblem problem = problem_of_surface(static_cast<std::size_t>(layers));
        extrusion = std::min(extrusion, seconds([&] { gmsh::model::mesh::generate(3); }));
        hexahedra = hexahedra_of_gmsh();
        for (int repeat = 0; repeat < 5; ++repeat) {
            std::size_t ours = 0;
            swept = std::min(swept, seconds([&] {
                                 const SweepResult result = sweep(problem);
                                 const std::vector<HexCorners> hexes = result.mesh.hexes();
                                 benchmark::DoNotOptimize(hexes.data());
                                 ours = hexes.size();
                             }));
            if (ours != hexahedra) {
                state.SkipWithError("the two meshes differ");
            }
        }
    }
    gmsh::finalize();
    state.counters["hexahedra"] = static_cast<double>(hexahedra);
    state.counters["gmsh_hex/s"] = static_cast<double>(hexahedra) / extrusion;
    state.counters["pavior_hex/s"] = static_cast<double>(hexahedra) / swept;
    state.counters["times_gmsh"] = extrusion / swept;
}
BENCHMARK(gmsh_extrusion)->Args({100, 50})->Args({200, 100})->Unit(benchmark::kMillisecond)->Iterations(2);

}  // namespace
#endif

// Small sweep problems, sound and broken: sweep() answers with a mesh that holds together, or with an InputError.
#include "bytes.hpp"

#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/sweep/sweep.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <array>

using namespace pavior;
using fuzz::Bytes;

namespace {

/// A grid of quads with some taken out, its nodes moved.
QuadMesh source_of(Bytes& bytes) {
    const std::size_t nx = 1 + bytes.below(4);
    const std::size_t ny = 1 + bytes.below(4);
    QuadMesh mesh;
    for (std::size_t j = 0; j <= ny; ++j) {
        for (std::size_t i = 0; i <= nx; ++i) {
            mesh.nodes.emplace_back(static_cast<double>(i) + 0.4 * bytes.number(),
                                    static_cast<double>(j) + 0.4 * bytes.number(), 0.4 * bytes.number());
        }
    }
    for (std::size_t j = 0; j < ny; ++j) {
        for (std::size_t i = 0; i < nx; ++i) {
            const auto a = static_cast<Index>(j * (nx + 1) + i);
            const auto up = static_cast<Index>(nx + 1);
            if (bytes.below(8) != 7) {
                mesh.quads.push_back({a, a + 1, a + 1 + up, a + up});
            }
        }
    }
    if (bytes.below(16) == 15 && !mesh.quads.empty()) {
        mesh.quads[bytes.below(mesh.quads.size())][bytes.below(4)] = bytes.byte();
    }
    return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    SweepOptions options;
    options.method =
        std::array{AffineMethod::constrained, AffineMethod::h, AffineMethod::g, AffineMethod::f}[bytes.below(4)];
    options.strategy = bytes.below(2) == 0 ? SweepStrategy::direct : SweepStrategy::front;
    options.correction =
        std::array{BoundaryCorrection::idw, BoundaryCorrection::harmonic, BoundaryCorrection::none}[bytes.below(3)];
    const QuadMesh source = source_of(bytes);
    const std::size_t layers = bytes.below(5);
    const double scale = 1 + 0.9 * bytes.number();
    const Vec3 step(bytes.number(), bytes.number(), 1 + bytes.number());
    const auto moved = [&](const Vec3& x, std::size_t k) {
        const double t = layers == 0 ? 0 : static_cast<double>(k) / static_cast<double>(layers);
        return Vec3((1 + t * (scale - 1)) * x + t * step);
    };
    try {
        const Loops loops = boundary_loops(source);
        std::vector<Vec3> target;
        for (const Vec3& x : source.nodes) {
            target.push_back(moved(x, layers));
        }
        std::vector<std::vector<Vec3>> levels(layers + 1);
        for (std::size_t k = 0; k <= layers; ++k) {
            for (const Index i : loops.nodes) {
                levels[k].push_back(moved(source.nodes[i], k));
            }
        }
        while (!bytes.empty() && bytes.below(4) == 3) {
            std::vector<Vec3>& level = levels[bytes.below(levels.size())];
            if (!level.empty()) {
                level[bytes.below(level.size())] += 0.5 * Vec3(bytes.number(), bytes.number(), bytes.number());
            }
        }
        const SweepProblem problem = make_sweep_problem(source, target, loops, levels);
        SweepResult one = sweep(problem, options);
        options.execution = Execution{2};
        const SweepResult two = sweep(problem, options);
        fuzz::require(std::equal(one.mesh.nodes().begin(), one.mesh.nodes().end(), two.mesh.nodes().begin(),
                                 two.mesh.nodes().end()));
        const SmoothReport smoothed = untangle_sweep(one.mesh, problem.loops, sequential);
        fuzz::require(smoothed.inverted_after <= smoothed.inverted_before);
        fuzz::require(one.mesh.hexes().size() == problem.quads.size() * problem.layers);
    } catch (const InputError&) {
    }
    return 0;
}

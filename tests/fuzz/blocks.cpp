// A few tetrahedra of a lattice, moved, with any features and cuts: block_solid() answers with blocks that its own
// report describes, or with an InputError.
#include "bytes.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/core/error.hpp>
#include <pavior/dual/features.hpp>

#include <array>

using namespace pavior;
using fuzz::Bytes;

namespace {

TetMesh lattice(Bytes& bytes) {
    const std::array<std::size_t, 3> n{1 + bytes.below(3), 1 + bytes.below(2), 1 + bytes.below(2)};
    const auto at = [&](const std::array<std::size_t, 3>& x) {
        return static_cast<Index>((x[2] * (n[1] + 1) + x[1]) * (n[0] + 1) + x[0]);
    };
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    TetMesh mesh;
    for (std::size_t k = 0; k <= n[2]; ++k) {
        for (std::size_t j = 0; j <= n[1]; ++j) {
            for (std::size_t i = 0; i <= n[0]; ++i) {
                mesh.nodes.push_back(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) +
                                     0.3 * Vec3(bytes.number(), bytes.number(), bytes.number()));
            }
        }
    }
    for (std::size_t box = 0; box < n[0] * n[1] * n[2]; ++box) {
        for (std::size_t o = 0; o < 6 && bytes.below(8) != 7; ++o) {
            std::array<std::size_t, 3> x{box % n[0], box / n[0] % n[1], box / n[0] / n[1]};
            TetCorners c{at(x), 0, 0, 0};
            for (std::size_t s = 0; s < 3; ++s) {
                ++x[orders[o][s]];
                c[s + 1] = at(x);
            }
            if (o >= 3) {
                std::swap(c[2], c[3]);
            }
            mesh.tets.push_back(c);
        }
    }
    if (bytes.below(16) == 15 && !mesh.tets.empty()) {
        mesh.tets[bytes.below(mesh.tets.size())][bytes.below(4)] = bytes.byte();
    }
    return mesh;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    BlockOptions options;
    options.mark = bytes.below(2) == 0;
    options.marking.marking = bytes.below(2) == 0 ? Marking::sheets : Marking::published;
    options.marking.propagation = bytes.below(2) == 0 ? Propagation::full : Propagation::stop;
    options.marking.max_rounds = 4;
    if (bytes.below(2) == 0) {
        options.refine.emplace();
        options.refine->size = 0.5;
    }
    try {
        ReferenceMesh mesh = make_reference_mesh(lattice(bytes));
        while (!options.mark && !bytes.empty() && !mesh.tets.empty()) {
            const TetCorners c = mesh.tets[bytes.below(mesh.tets.size())];
            mesh.layers.push_back({c[0], c[1], c[2 + bytes.below(2)]});
        }
        const SolidBlocks solid = block_solid(mesh, options);
        for (const HexCorners& hex : solid.blocks.hexes) {
            for (const Index i : hex) {
                fuzz::require(i < solid.blocks.nodes.size());
            }
        }
        fuzz::require(!solid.report.dual.valid() || solid.report.blocks.conforming());
    } catch (const InputError&) {
    } catch (const UnmeshableError&) {
    }
    return 0;
}

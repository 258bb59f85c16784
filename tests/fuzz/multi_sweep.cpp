// Small stacks of polygons: multi_sweep() answers with a conforming mesh, or with an error of ours.
#include "bytes.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/core/error.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/many_to_many/polygon_body.hpp>
#include <pavior/mesh/verify_hexes.hpp>

using namespace pavior;
using fuzz::Bytes;

namespace {

/// A rectangle on a lattice of quarters, or any polygon of up to six points.
std::vector<Vec2> polygon(Bytes& bytes) {
    if (bytes.below(4) != 3) {
        const Vec2 low(0.25 * static_cast<double>(bytes.below(8)), 0.25 * static_cast<double>(bytes.below(8)));
        const Vec2 extent(0.25 * static_cast<double>(1 + bytes.below(8)),
                          0.25 * static_cast<double>(1 + bytes.below(8)));
        return {low, low + Vec2(extent[0], 0), low + extent, low + Vec2(0, extent[1])};
    }
    std::vector<Vec2> points(bytes.below(7));
    for (Vec2& p : points) {
        p = Vec2(bytes.number(), bytes.number());
    }
    return points;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    std::vector<PolygonCap> caps;
    const std::size_t solids = 1 + bytes.below(2);
    for (std::size_t s = 0; s < solids; ++s) {
        const std::vector<Vec2> outline = polygon(bytes);
        const double low = static_cast<double>(bytes.below(4));
        const auto id = static_cast<Index>(s);
        caps.push_back({{outline}, low, Vec2::Zero(), no_index, id});
        const double high = low + static_cast<double>(bytes.below(4));
        if (bytes.below(2) == 0) {
            caps.push_back({{outline}, high, Vec2(0.2 * bytes.number(), 0.2 * bytes.number()), id, no_index});
        } else {  // a step: one part ends lower
            const std::vector<Vec2> part = polygon(bytes);
            caps.push_back({{outline, part}, high, Vec2::Zero(), id, no_index});
            caps.push_back({{part}, 0.5 * (low + high), Vec2::Zero(), id, no_index});
        }
    }
    MultiSweepOptions options;
    options.size = 0.5 + 0.25 * static_cast<double>(bytes.below(4));
    try {
        const PolygonBody body(std::move(caps));
        const MultiSweepMesh made = multi_sweep(body.body(), body, options, imprint, GlpkSolver{}, GmshRegionMesher{});
        for (const HexCorners& hex : made.mesh.hexes) {
            for (const Index i : hex) {
                fuzz::require(i < made.mesh.nodes.size());
            }
        }
    } catch (const Error&) {
    }
    return 0;
}

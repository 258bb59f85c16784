#pragma once

#include <pavior/core/error.hpp>
#include <pavior/smooth/detail/surface_model.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/surface_quads.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE SmoothReport untangle_on_surface(const SurfaceView& surface, std::span<Vec2> uv,
                                               std::span<const QuadCorners> quads, std::span<const std::uint8_t> fixed,
                                               const UntangleOptions& options, std::span<const Vec3> reference_nodes) {
    check_options(options);
    check_cells<2>(quads, uv.size(), fixed.size());
    check_finite<Vec2>(uv, "parameter of node");
    check_finite<Vec3>(reference_nodes, "reference node");
    if (!reference_nodes.empty() && reference_nodes.size() != uv.size()) {
        throw InputError(ErrorCode::size_mismatch, "the reference must have one node per node of the mesh, or none");
    }
    std::vector<QuadCorners> turned;
    if (options.reversed) {
        turned.assign(quads.begin(), quads.end());
        for (QuadCorners& corners : turned) {
            std::swap(corners[1], corners[3]);
        }
        quads = turned;
    }
    SurfaceModel<SurfaceView> model(surface, uv, quads, fixed, reference_nodes, options);
    return done_or_undone(uv,
                          [&] { return Untangler<2, SurfaceModel<SurfaceView>>(model, quads, fixed, options).run(); });
}

}  // namespace pavior::detail

#pragma once
/// \file
/// Checks of hexahedral meshes: conforming, valid, closed.

#include <pavior/core/compiled.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/near_nodes.hpp>
#include <pavior/mesh/verify_report.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// Options of verify_hexes().
struct VerifyHexesOptions {
    std::size_t cap = 16;  ///< offenders of a kind whose ids are kept
    /// Nodes nearer than this times the diagonal of the bounding box are duplicates; negative: not checked.
    double node_tolerance = 1e-9;
    /// Relative difference allowed between the sum of volumes and the flux through the boundary.
    double volume_tolerance = 1e-10;
    /// det J must be positive at (samples + 1)^3 lattice points of each hexahedron; 1: at the corners.
    int samples = 1;
    bool allow_unused_nodes = false;  ///< true: nodes of no hexahedron are no fault
    Execution execution = sequential;
};

/// Result of verify_hexes().
struct HexReport : VerifyReport {
    using VerifyReport::VerifyReport;
    std::size_t inner_quads = 0;
    std::size_t boundary_quads = 0;
    std::size_t crossed_edges = 0;  ///< edges of four or more boundary quads: the boundary touches itself (no fault)
    double volume = 0.0;            ///< sum of the exact volumes of the hexahedra with sound ids
    double boundary_flux = 0.0;     ///< flux of x/3 out of the boundary
    double min_det = 0.0;           ///< smallest sampled det J; NaN if a coordinate is not finite
};

namespace detail {

/// Corners of a hexahedron or quad, moved and scaled.
template <std::size_t N, class M>
[[nodiscard]] std::array<Vec3, N> cell_points(const M& mesh, const std::array<Index, N>& corners, const Vec3& origin,
                                              double unit) {
    std::array<Vec3, N> x;
    for (std::size_t i = 0; i < N; ++i) {
        x[i] = (node(mesh, corners[i]) - origin) / unit;
    }
    return x;
}

/// Frame in which the mesh has size 1 about its centre, so that no power of a coordinate overflows.
struct Frame {
    Vec3 origin;
    double unit;
};

struct VolumeScan {
    double volume = 0.0;
    double absolute = 0.0;
    double min_det = std::numeric_limits<double>::infinity();
    VerifyReport faults;
};

template <hex_mesh M>
[[nodiscard]] VolumeScan scan_volumes(const M& mesh, std::span<const char> bad, const Frame& frame,
                                      const VerifyHexesOptions& options) {
    const auto chunks = map_chunks(options.execution, bad.size(), 4096, [&](std::size_t begin, std::size_t end) {
        VolumeScan scan{.faults = VerifyReport(options.cap)};
        for (std::size_t h = begin; h < end; ++h) {
            if (bad[h] != 0) {
                continue;
            }
            const HexPoints x = cell_points(mesh, hex(mesh, static_cast<Index>(h)), frame.origin, frame.unit);
            const double det = hex_min_det(x, options.samples);
            const double volume = hex_volume(x);
            scan.volume += volume;
            scan.absolute += std::abs(volume);
            scan.min_det = det >= scan.min_det ? scan.min_det : det;
            if (!(det > 0.0)) {
                scan.faults.add(MeshFault::inverted, {static_cast<std::int64_t>(h)});
            }
        }
        return scan;
    });
    VolumeScan all{.faults = VerifyReport(options.cap)};
    for (const VolumeScan& chunk : chunks) {
        all.volume += chunk.volume;
        all.absolute += chunk.absolute;
        all.min_det = chunk.min_det >= all.min_det ? all.min_det : chunk.min_det;
        all.faults.append(chunk.faults);
    }
    return all;
}

template <hex_mesh M>
void check_volume(const M& mesh, std::span<const char> bad, const FaceScan& faces, const VerifyHexesOptions& options,
                  HexReport& report) {
    const Box<Vec3> box = bounds(mesh);
    const Frame frame{box.centre(), box.diagonal() > 0.0 ? box.diagonal() : 1.0};
    const VolumeScan scan = scan_volumes(mesh, bad, frame, options);
    double flux = 0.0;
    for (const QuadCorners& c : faces.boundary) {
        flux += quad_flux(cell_points(mesh, c, frame.origin, frame.unit));
    }
    report.append(scan.faults);
    if (!(std::abs(scan.volume - flux) <= options.volume_tolerance * std::max(std::abs(flux), scan.absolute))) {
        report.add(MeshFault::volume_mismatch, {});
    }
    const double scale = frame.unit * frame.unit * frame.unit;
    report.volume = scan.volume * scale;
    report.boundary_flux = flux * scale;
    report.min_det = std::isinf(scan.min_det) ? 0.0 : scan.min_det * scale;
}

PAVIOR_INLINE void check_closed(std::size_t nodes, const std::vector<QuadCorners>& quads, HexReport& report);

PAVIOR_INLINE void compare_boundary(std::span<const QuadCorners> given, const std::vector<QuadCorners>& found,
                                    HexReport& report);

template <hex_mesh M>
void check_hex_nodes(const M& mesh, const VerifyHexesOptions& options, HexReport& report) {
    const std::size_t nodes = node_count(mesh);
    std::vector<char> used(nodes, options.allow_unused_nodes ? 1 : 0);
    for (const Index h : IndexRange(hex_count(mesh))) {
        for (const Index i : hex(mesh, h)) {
            if (i < nodes) {
                used[i] = 1;
            }
        }
    }
    for (const Index i : IndexRange(nodes)) {
        if (!node(mesh, i).allFinite()) {
            report.add(MeshFault::not_finite, {i});
        }
        if (used[i] == 0) {
            report.add(MeshFault::unused_node, {i});
        }
    }
    if (options.node_tolerance >= 0.0) {
        for (const auto& pair : near_nodes(mesh, options.node_tolerance * bounds(mesh).diagonal())) {
            report.add(MeshFault::duplicate_node, {pair[0], pair[1]});
        }
    }
}

template <hex_mesh M>
[[nodiscard]] HexReport verify_hexes(const M& mesh, std::optional<std::span<const QuadCorners>> boundary,
                                     const VerifyHexesOptions& options) {
    if (options.samples < 1) {
        throw InputError(ErrorCode::bad_option, "samples must be at least 1, not " + std::to_string(options.samples));
    }
    HexReport report(options.cap);
    if (hex_count(mesh) == 0) {
        report.add(MeshFault::empty, {});
    }
    const std::vector<char> bad = check_hex_corners(mesh, report);
    check_hex_nodes(mesh, options, report);
    const FaceScan faces = scan_faces(mesh, bad, options.cap, options.execution);
    report.append(faces.faults);
    report.inner_quads = faces.inner;
    report.boundary_quads = faces.boundary.size();
    check_closed(node_count(mesh), faces.boundary, report);
    if (boundary) {
        compare_boundary(*boundary, faces.boundary, report);
    }
    check_volume(mesh, bad, faces, options, report);
    return report;
}

}  // namespace detail

/// Checks \p mesh and lists every fault: `empty`, `not_finite`, `id_out_of_range`, `repeated_node`, `overused` (quad of
/// three or more hexahedra), `same_sense` (its two hexahedra do not see a quad from opposite sides, or disagree on the
/// order of its nodes), `unused_node`, `duplicate_node`, `inverted`, `open_boundary`, `volume_mismatch`. Hexahedra with
/// bad ids are left out of the checks of quads and volumes.
/// O(n log n), about 150 bytes a hexahedron; the same bytes for any number of threads; read-only and thread-safe.
/// Throws InputError (bad_option) for samples < 1.
template <hex_mesh M>
[[nodiscard]] HexReport verify_hexes(const M& mesh, const VerifyHexesOptions& options = {}) {
    return detail::verify_hexes(mesh, std::nullopt, options);
}

/// As above, and the boundary must be exactly \p boundary: outward quads in any order, each from any of its corners.
/// Quads given the wrong way round are `boundary_missing`, and their reverses `boundary_extra`.
template <hex_mesh M>
[[nodiscard]] HexReport verify_hexes(const M& mesh, std::span<const QuadCorners> boundary,
                                     const VerifyHexesOptions& options = {}) {
    return detail::verify_hexes(mesh, boundary, options);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/verify_hexes-inl.hpp>
#endif

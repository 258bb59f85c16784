#pragma once
/// \file
/// The boundary of a hexahedral mesh.

#include <pavior/core/chunks.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/verify_report.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {
/// The quads of a mesh sorted into boundary, inner and faulty.
struct FaceScan {
    std::vector<QuadCorners> boundary;  ///< used once; outward, from the smallest node
    std::size_t inner = 0;              ///< used twice, from both sides
    VerifyReport faults;                ///< overused, same_sense
};

inline void record(VerifyReport& report, MeshFault fault, const QuadCorners& c) {
    report.add(fault, {c[0], c[1], c[2], c[3]});
}

template <hex_mesh M>
void scan_face(const M& mesh, std::span<const FaceTable::Use> uses, FaceScan& scan) {
    const auto corners = [&](const FaceTable::Use& use) { return hex_face(hex(mesh, use.hex()), use.local()); };
    const QuadCorners first = from_smallest(corners(uses[0]));
    if (uses.size() == 1) {
        scan.boundary.push_back(first);
    } else if (uses.size() > 2) {
        record(scan.faults, MeshFault::overused, first);
    } else if (!opposite(first, corners(uses[1]))) {
        record(scan.faults, MeshFault::same_sense, first);
    } else {
        ++scan.inner;
    }
}

template <hex_mesh M>
[[nodiscard]] FaceScan scan_faces(const M& mesh, std::span<const char> skip, std::size_t cap, Execution execution) {
    const FaceTable table(mesh, skip);
    auto chunks = map_chunks(execution, table.node_count(), 4096, [&](std::size_t begin, std::size_t end) {
        FaceScan scan{{}, 0, VerifyReport(cap)};
        table.for_each(mesh, begin, end,
                       [&](Index, std::span<const FaceTable::Use> uses) { scan_face(mesh, uses, scan); });
        return scan;
    });
    FaceScan all{{}, 0, VerifyReport(cap)};
    for (FaceScan& chunk : chunks) {
        all.boundary.insert(all.boundary.end(), chunk.boundary.begin(), chunk.boundary.end());
        all.inner += chunk.inner;
        all.faults.append(chunk.faults);
        chunk = FaceScan{};  // frees it
    }
    return all;
}

/// Marks hexahedra with a node out of range or twice, and records them.
template <hex_mesh M>
[[nodiscard]] std::vector<char> check_hex_corners(const M& mesh, VerifyReport& report) {
    const std::size_t nodes = node_count(mesh);
    std::vector<char> bad(hex_count(mesh), 0);
    for (const Index h : IndexRange(bad.size())) {
        HexCorners c = hex(mesh, h);
        std::sort(c.begin(), c.end());
        if (c[7] >= nodes) {
            report.add(MeshFault::id_out_of_range, {h});
            bad[h] = 1;
        } else if (std::adjacent_find(c.begin(), c.end()) != c.end()) {
            report.add(MeshFault::repeated_node, {h});
            bad[h] = 1;
        }
    }
    return bad;
}
}  // namespace detail

/// The quads of \p mesh that one hexahedron uses, counter-clockwise seen from outside the mesh, each from its smallest
/// node, in ascending order of their sorted nodes. Coordinates are not looked at. Empty for an empty mesh.
/// Throws InputError: bad_index (ids: hexahedra) for node ids out of range or named twice by one hexahedron;
/// non_manifold (four nodes a quad) for quads of more than two hexahedra; bad_orientation (likewise) for quads that two
/// hexahedra see from the same side, or with their nodes in another order.
/// O(n), 48 bytes a hexahedron and 8 a node; the same bytes for any number of threads.
template <hex_mesh M>
[[nodiscard]] std::vector<QuadCorners> boundary_quads(const M& mesh, Execution execution = sequential) {
    VerifyReport report;
    const std::vector<char> bad = detail::check_hex_corners(mesh, report);
    report.throw_if_bad();
    detail::FaceScan scan = detail::scan_faces(mesh, bad, 16, execution);
    scan.faults.throw_if_bad();
    return std::move(scan.boundary);
}

}  // namespace pavior

#pragma once

#include <pavior/marking/faces.hpp>
#include <pavior/marking/repair_corner.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// The tetrahedra round a node that hang together with \p first across free faces.
[[nodiscard]] inline std::vector<Index> corner_tets(const ReferenceMesh& mesh, const CellSnapshot& s, Index node,
                                                    Index first) {
    std::vector<Index> tets{first};
    for (std::size_t i = 0; i < tets.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index f = s.topology.tet_faces[tets[i]][k];
            if (s.classes.face[f] == EntityClass::layer || mesh.tets[tets[i]][k] == node) {
                continue;
            }
            const Index other = s.topology.across(f, tets[i]);
            if (std::find(tets.begin(), tets.end(), other) == tets.end()) {
                tets.push_back(other);
            }
        }
    }
    return tets;
}

[[nodiscard]] inline CornerRing corner_ring(const ReferenceMesh& mesh, const CellSnapshot& s,
                                            const CellCorner& corner) {
    CornerRing ring;
    ring.node = s.complex.vertices[corner.vertex];
    ring.tets = corner_tets(mesh, s, ring.node, corner.tet);
    std::vector<std::array<Index, 2>> next;  // seen from the node, each layer face leads from one edge to the next
    for (const Index t : ring.tets) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index f = s.topology.tet_faces[t][k];
            if (mesh.tets[t][k] == ring.node || s.classes.face[f] != EntityClass::layer) {
                continue;
            }
            const TriCorners face = tet_face(mesh.tets[t], k);
            const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), ring.node) - face.begin());
            next.push_back({face[(at + 1) % 3], face[(at + 2) % 3]});
        }
    }
    std::sort(next.begin(), next.end());
    Index i = next.front()[0];
    for (std::size_t step = 0; step < next.size(); ++step) {
        const Index e = s.topology.edge(ring.node, i);
        if (s.classes.edge[e] == EntityClass::stack) {
            ring.chains.push_back(s.complex.edge_chain[e]);
            ring.directions.push_back((mesh.nodes[i] - mesh.nodes[ring.node]).stableNormalized());
        }
        i = (*std::lower_bound(next.begin(), next.end(), std::array<Index, 2>{i, 0}))[1];
    }
    return ring;
}

/// Normal of the plane through two chains; if these are opposite, that which parts the others best.
[[nodiscard]] inline Vec3 split_normal(const CornerRing& ring, std::size_t i, std::size_t j) {
    const Vec3 normal = ring.directions[i].cross(ring.directions[j]);
    if (normal.norm() >= 1e-3 || ring.directions[i].dot(ring.directions[j]) > 0) {
        return normal.norm() >= 1e-3 ? Vec3(normal.normalized()) : Vec3(0, 0, 0);
    }
    Vec3 apart(0, 0, 0);
    for (std::size_t k = 0; k < ring.directions.size(); ++k) {
        if (k != i && k != j) {
            const Vec3 across = ring.directions[k] - ring.directions[i].dot(ring.directions[k]) * ring.directions[i];
            apart += (i < k && k < j ? 1 : -1) * across.stableNormalized();
        }
    }
    return apart.norm() > 0.1 ? Vec3(apart.normalized()) : Vec3(0, 0, 0);
}

PAVIOR_INLINE std::optional<CornerSplit> try_split(const CornerRing& ring, std::size_t i, std::size_t j) {
    CornerSplit split{i, j, split_normal(ring, i, j), 0, 1, 0};
    double side = 0;
    for (std::size_t k = 0; k < ring.directions.size(); ++k) {
        if (k == i || k == j) {
            continue;
        }
        const double v = split.normal.dot(ring.directions[k]) * (i < k && k < j ? 1 : -1);
        if (side * v < 0) {
            return std::nullopt;
        }
        side = v;
        split.clearance = std::min(split.clearance, std::abs(v));
    }
    return split.clearance > 1e-3 ? std::optional(split) : std::nullopt;
}

inline void count_passes(const ReferenceMesh& mesh, const CellSnapshot& s, const CornerRing& ring, double tolerance,
                         double size, CornerSplit& split) {
    for (const Index i : s.complex.vertices) {
        const double d = std::abs(split.normal.dot(mesh.nodes[i] - mesh.nodes[ring.node]));
        split.passes += d <= 20 * tolerance ? 1 : d <= 0.01 * size ? -2 : 0;
        split.spread += d / (size * static_cast<double>(s.complex.vertices.size()));
    }
}

/// The best plane through two chains of a corner that are no neighbours.
[[nodiscard]] inline std::optional<CornerSplit> best_split(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                           const CornerRing& ring, double tolerance, double size) {
    std::optional<CornerSplit> best;
    for (std::size_t i = 0; i < ring.chains.size(); ++i) {
        for (std::size_t j = i + 2; j < ring.chains.size() - (i == 0 ? 1 : 0); ++j) {
            std::optional<CornerSplit> split = try_split(ring, i, j);
            if (!split) {
                continue;
            }
            count_passes(mesh, s, ring, tolerance, size, *split);
            if (!best || split->better_than(*best)) {
                best = split;
            }
        }
    }
    return best;
}

/// Chains that are not straight: the sheet is ruled between the two, as facets along both.
[[nodiscard]] inline PatchSurface surface_through(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                  const CornerRing& ring, const CornerSplit& split, double tolerance,
                                                  RepairSheet& repair) {
    PatchSurface surface;
    surface.axis = split.normal;
    surface.point = mesh.nodes[ring.node];
    bool straight = true;
    for (const std::size_t k : {split.first, split.second}) {
        for (const Index i : s.complex.chain_path(ring.chains[k])) {
            straight = straight && std::abs(surface.distance(mesh.nodes[i])) <= 20 * tolerance;
        }
    }
    if (straight) {
        return surface;
    }
    const std::array<std::size_t, 2> both{split.first, split.second};
    for (std::size_t k = 0; k < 2; ++k) {
        const auto path = s.complex.chain_path(ring.chains[both[k]]);
        const bool backwards = path.front() != ring.node;
        for (std::size_t e = 0; e + 1 < path.size(); ++e) {
            const Vec3& a = mesh.nodes[path[e]];
            const Vec3& b = mesh.nodes[path[e + 1]];
            const Vec3 along = (backwards ? Vec3(a - b) : Vec3(b - a)).stableNormalized();
            const Vec3 normal = k == 0 ? along.cross(ring.directions[both[1]]) : ring.directions[both[0]].cross(along);
            if (normal.norm() > 0.1) {
                surface.facets.push_back({0.5 * (a + b), normal.normalized(), (b - a).squaredNorm()});
            }
            repair.contained.push_back(ascending(path[e], path[e + 1]));
        }
    }
    surface.kind = surface.facets.empty() ? SurfaceKind::plane : SurfaceKind::facets;
    return surface;
}

/// The sheet of a split.
[[nodiscard]] inline RepairSheet split_sheet(const ReferenceMesh& mesh, const CellSnapshot& s, const CornerRing& ring,
                                             const CornerSplit& split, double tolerance) {
    RepairSheet repair;
    repair.kind = SheetKind::corner;
    repair.node = ring.node;
    repair.tets = ring.tets;
    repair.surface = surface_through(mesh, s, ring, split, tolerance, repair);
    return repair;
}

PAVIOR_INLINE std::optional<RepairSheet> cross_sheet(const ReferenceMesh& mesh, const CornerRing& ring) {
    if (ring.directions.empty() || ring.directions.size() > 2) {
        return std::nullopt;
    }
    const Vec3 apart = ring.directions.size() == 1 ? ring.directions[0] : Vec3(ring.directions[0] - ring.directions[1]);
    if (!(apart.norm() > 1e-3)) {
        return std::nullopt;
    }
    RepairSheet repair;
    repair.kind = SheetKind::corner;
    repair.node = ring.node;
    repair.tets = ring.tets;
    repair.surface.point = mesh.nodes[ring.node];
    repair.surface.axis = apart.normalized();
    return repair;
}

/// Corners with one ring of chains that do not have three, most chains first.
[[nodiscard]] inline std::vector<std::pair<Index, std::size_t>> bad_corners(const CellSnapshot& s) {
    std::vector<std::pair<Index, std::size_t>> order;
    for (std::size_t k = 0; k < s.complex.corners.size(); ++k) {
        if (s.complex.corners[k].rings == 1 && s.complex.corners[k].valence != 3) {
            order.emplace_back(~s.complex.corners[k].valence, k);
        }
    }
    std::stable_sort(order.begin(), order.end());
    return order;
}

}  // namespace detail

PAVIOR_INLINE std::optional<RepairSheet> repair_corner(const ReferenceMesh& mesh, const CellSnapshot& s,
                                                       double tolerance, double size) {
    const auto order = detail::bad_corners(s);
    for (const auto& [valence, k] : order) {
        const CellCorner& corner = s.complex.corners[k];
        const detail::CornerRing ring = detail::corner_ring(mesh, s, corner);
        if (corner.valence > 3) {
            if (const auto split = detail::best_split(mesh, s, ring, tolerance, size)) {
                return detail::split_sheet(mesh, s, ring, *split, tolerance);
            }
        } else if (s.complex.corners[order.front().second].valence > 3) {
            break;
        } else if (std::optional<RepairSheet> sheet = detail::cross_sheet(mesh, ring)) {
            return sheet;
        }
    }
    return std::nullopt;
}

}  // namespace pavior

#pragma once
// What every tetrahedral mesh must fulfil, checked without the code under test; and surfaces made in code.

#include <pavior/mesh/tagged_mesh.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tets {

using pavior::Index;
using pavior::TaggedSurface;
using pavior::TaggedTetMesh;
using pavior::TriCorners;
using pavior::Vec3;

template <class Corners>
Corners sorted(Corners c) {
    std::sort(c.begin(), c.end());
    return c;
}

/// The same triangle in the same sense, starting at its smallest node.
inline TriCorners from_smallest(TriCorners c) {
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
}

inline double volume(const pavior::TetMesh& mesh) {
    double sum = 0.0;
    for (const auto& c : mesh.tets) {
        const Vec3& x = mesh.nodes[c[0]];
        sum += (mesh.nodes[c[1]] - x).cross(mesh.nodes[c[2]] - x).dot(mesh.nodes[c[3]] - x) / 6.0;
    }
    return sum;
}

inline double volume(const pavior::TriMesh& mesh) {
    double sum = 0.0;
    const Vec3& x = mesh.nodes.at(0);
    for (const auto& c : mesh.triangles) {
        sum += (mesh.nodes[c[0]] - x).cross(mesh.nodes[c[1]] - x).dot(mesh.nodes[c[2]] - x) / 6.0;
    }
    return sum;
}

/// Altitude by longest edge of the flattest tetrahedron; negative if one is inverted.
inline double flattest(const pavior::TetMesh& mesh) {
    double worst = 1.0;
    for (const auto& c : mesh.tets) {
        double edge = 0.0;
        double face = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                edge = std::max(edge, (mesh.nodes[c[i]] - mesh.nodes[c[j]]).norm());
                for (std::size_t k = 0; k < 4; ++k) {
                    face = std::max(
                        face, (mesh.nodes[c[j]] - mesh.nodes[c[i]]).cross(mesh.nodes[c[k]] - mesh.nodes[c[i]]).norm());
                }
            }
        }
        const Vec3& x = mesh.nodes[c[0]];
        const double six = (mesh.nodes[c[1]] - x).cross(mesh.nodes[c[2]] - x).dot(mesh.nodes[c[3]] - x);
        worst = std::min(worst, six / face / edge);
    }
    return worst;
}

/// Empty if the mesh is sound: ids in range, all nodes used, faces of at most two tetrahedra, and `triangles` hold each
/// boundary face once, outward; the others are faces inside. Else what is wrong.
inline std::string fault(const TaggedTetMesh& mesh) {
    static constexpr int local[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    std::map<TriCorners, std::vector<TriCorners>> faces;
    std::vector<char> used(mesh.mesh.nodes.size(), 0);
    for (const auto& c : mesh.mesh.tets) {
        for (const Index node : c) {
            if (node >= used.size()) {
                return "node out of range";
            }
            used[node] = 1;
        }
        for (const auto& f : local) {
            const TriCorners face{c[static_cast<std::size_t>(f[0])], c[static_cast<std::size_t>(f[1])],
                                  c[static_cast<std::size_t>(f[2])]};
            faces[sorted(face)].push_back(from_smallest(face));
        }
    }
    if (std::count(used.begin(), used.end(), 0) != 0) {
        return "unused node";
    }
    std::map<TriCorners, TriCorners> listed;
    for (const auto& triangle : mesh.triangles) {
        if (!faces.contains(sorted(triangle.nodes))) {
            return "a triangle is no face of a tetrahedron";
        }
        if (!listed.emplace(sorted(triangle.nodes), from_smallest(triangle.nodes)).second) {
            return "a triangle is listed twice";
        }
    }
    for (const auto& [key, uses] : faces) {
        if (uses.size() > 2) {
            return "a face of three tetrahedra";
        }
        if (uses.size() == 1 && (!listed.contains(key) || listed.at(key) != uses[0])) {
            return "a boundary face is not listed, or not outward";
        }
    }
    return "";
}

/// Triangles of `mesh` that are boundary faces, by their nodes and tags.
inline std::set<std::pair<TriCorners, int>> triangle_set(const TaggedTetMesh& mesh) {
    std::set<std::pair<TriCorners, int>> set;
    for (const auto& triangle : mesh.triangles) {
        set.emplace(from_smallest(triangle.nodes), triangle.tag);
    }
    return set;
}

inline std::set<std::pair<TriCorners, int>> triangle_set(const TaggedSurface& surface) {
    std::set<std::pair<TriCorners, int>> set;
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        set.emplace(from_smallest(surface.mesh.triangles[t]), surface.face_tags.empty() ? 0 : surface.face_tags[t]);
    }
    return set;
}

/// Area by tag.
inline std::map<int, double> areas(const std::vector<Vec3>& nodes, const std::set<std::pair<TriCorners, int>>& set) {
    std::map<int, double> result;
    for (const auto& [c, tag] : set) {
        result[tag] += (nodes[c[1]] - nodes[c[0]]).cross(nodes[c[2]] - nodes[c[0]]).norm() / 2.0;
    }
    return result;
}

/// Length by tag.
inline std::map<int, double> lengths(const std::vector<Vec3>& nodes, const std::vector<pavior::TaggedEdge>& edges) {
    std::map<int, double> result;
    for (const auto& edge : edges) {
        result[edge.tag] += (nodes[edge.nodes[0]] - nodes[edge.nodes[1]]).norm();
    }
    return result;
}

/// A file of tests/data/block: OFF with triangles.
inline TaggedSurface load(const std::string& name) {
    std::ifstream file(std::string(PAVIOR_TEST_DATA) + "/block/" + name);
    std::string word;
    std::size_t nodes = 0;
    std::size_t triangles = 0;
    std::size_t rest = 0;
    TaggedSurface surface;
    file >> word >> nodes >> triangles >> rest;
    surface.mesh.nodes.resize(nodes);
    surface.mesh.triangles.resize(triangles);
    for (Vec3& x : surface.mesh.nodes) {
        file >> x[0] >> x[1] >> x[2];
    }
    for (TriCorners& c : surface.mesh.triangles) {
        file >> rest >> c[0] >> c[1] >> c[2];
    }
    if (!file) {
        throw std::runtime_error("cannot read " + name);
    }
    return surface;
}

inline const std::vector<std::string>& names() {
    static const std::vector<std::string> list{
        "c01_brick_tapered",  "c02_L_rounded", "c03_triangular_protrusions", "c04_half_gear", "c05_plate_two_holes",
        "c06_closed_loop",    "c07_pyramid4",  "c10_three_protrusions",      "c13_cavity",    "c15_tilted_T",
        "c17_notch_reversal", "c20_cylinder"};
    return list;
}

/// A box with 12 triangles; sides have the tags 1 2 (low, high x) 3 4 (y) 5 6 (z). Edges on the sides p and q are
/// tagged 10 p + q, p < q; vertices 1 to 8.
inline TaggedSurface box(const Vec3& low = Vec3::Zero(), const Vec3& high = Vec3::Ones()) {
    TaggedSurface s;
    for (int i = 0; i < 8; ++i) {
        s.mesh.nodes.emplace_back(i % 2 != 0 ? high.x() : low.x(), i / 2 % 2 != 0 ? high.y() : low.y(),
                                  i / 4 != 0 ? high.z() : low.z());
        s.vertices.push_back({static_cast<Index>(i), i + 1});
    }
    const auto quad = [&](Index a, Index b, Index c, Index d, int tag) {
        s.mesh.triangles.push_back({a, b, c});
        s.mesh.triangles.push_back({a, c, d});
        s.face_tags.insert(s.face_tags.end(), {tag, tag});
    };
    quad(0, 4, 6, 2, 1);
    quad(1, 3, 7, 5, 2);
    quad(0, 1, 5, 4, 3);
    quad(2, 6, 7, 3, 4);
    quad(0, 2, 3, 1, 5);
    quad(4, 5, 7, 6, 6);
    for (Index i = 0; i < 8; ++i) {
        for (const unsigned bit : {0U, 1U, 2U}) {
            const Index j = i | 1U << bit;
            if (i != j) {
                const auto side = [&](unsigned axis) { return static_cast<int>(2 * axis + 1 + (i >> axis & 1U)); };
                const std::array<int, 2> sides{side(bit == 0 ? 1 : 0), side(bit == 2 ? 1 : 2)};
                s.edges.push_back({{i, j}, 10 * sides[0] + sides[1]});
            }
        }
    }
    return s;
}

/// Both surfaces in one, the tags of the second raised by 100; inside out if asked for.
inline TaggedSurface joined(TaggedSurface a, const TaggedSurface& b, bool turned = false) {
    const auto shift = static_cast<Index>(a.mesh.nodes.size());
    a.mesh.nodes.insert(a.mesh.nodes.end(), b.mesh.nodes.begin(), b.mesh.nodes.end());
    for (std::size_t t = 0; t < b.mesh.triangles.size(); ++t) {
        const TriCorners& c = b.mesh.triangles[t];
        a.mesh.triangles.push_back(turned ? TriCorners{c[0] + shift, c[2] + shift, c[1] + shift}
                                          : TriCorners{c[0] + shift, c[1] + shift, c[2] + shift});
        a.face_tags.push_back(b.face_tags[t] + 100);
    }
    for (const auto& edge : b.edges) {
        a.edges.push_back({{edge.nodes[0] + shift, edge.nodes[1] + shift}, edge.tag + 100});
    }
    for (const auto& vertex : b.vertices) {
        a.vertices.push_back({vertex.node + shift, vertex.tag + 100});
    }
    return a;
}

/// The surface turned by some angle about some axis, the same for the same number; 0: not at all.
inline TaggedSurface turned(TaggedSurface surface, int number) {
    if (number != 0) {
        const Eigen::Quaterniond q(std::cos(0.7 + number), std::sin(1.9 * number), std::cos(2.3 * number),
                                   std::sin(0.4 + 3.1 * number));
        for (Vec3& x : surface.mesh.nodes) {
            x = q.normalized() * x;
        }
    }
    return surface;
}

}  // namespace tets

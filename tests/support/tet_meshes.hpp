#pragma once
// Tetrahedral meshes for tests: voxel solids cut into six tetrahedra a box, reference meshes from files, and the
// smallest type that models classified_tet_mesh.

#include "support/foreign_meshes.hpp"

#include <pavior/dual/features.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tet_meshes {

using pavior::Index;
using pavior::TetCorners;
using pavior::Vec3;

/// A solid of voxels: inside(i, j, k) for 0 <= i < size[0] ...
struct Voxels {
    std::array<Index, 3> size{1, 1, 1};
    std::vector<char> inside;

    [[nodiscard]] bool operator()(int i, int j, int k) const {
        const std::array<int, 3> at{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at[axis] < 0 || at[axis] >= static_cast<int>(size[axis])) {
                return false;
            }
        }
        return inside[(static_cast<std::size_t>(k) * size[1] + static_cast<std::size_t>(j)) * size[0] +
                      static_cast<std::size_t>(i)] != 0;
    }
};

inline Voxels voxels(std::array<Index, 3> size, const std::function<bool(Index, Index, Index)>& inside) {
    Voxels v{size, {}};
    for (Index k = 0; k < size[2]; ++k) {
        for (Index j = 0; j < size[1]; ++j) {
            for (Index i = 0; i < size[0]; ++i) {
                v.inside.push_back(inside(i, j, k) ? 1 : 0);
            }
        }
    }
    return v;
}

inline Voxels box(Index a, Index b, Index c) {
    return voxels({a, b, c}, [](Index, Index, Index) { return true; });
}

/// The three corners of boxes round a lattice node or edge touch only there: the boundary is no manifold.
inline bool manifold(const Voxels& v) {
    const auto split_edge = [](bool a, bool b, bool c, bool d) { return a == d && b == c && a != b; };
    for (int k = 0; k <= static_cast<int>(v.size[2]); ++k) {
        for (int j = 0; j <= static_cast<int>(v.size[1]); ++j) {
            for (int i = 0; i <= static_cast<int>(v.size[0]); ++i) {
                const auto at = [&](int x, int y, int z) { return v(i - x, j - y, k - z); };
                for (const int s : {0, 1}) {
                    if (split_edge(at(0, 0, s), at(1, 0, s), at(0, 1, s), at(1, 1, s)) ||
                        split_edge(at(0, s, 0), at(1, s, 0), at(0, s, 1), at(1, s, 1)) ||
                        split_edge(at(s, 0, 0), at(s, 1, 0), at(s, 0, 1), at(s, 1, 1))) {
                        return false;
                    }
                }
                int count = 0;
                for (int n = 0; n < 8; ++n) {
                    count += at(n & 1, n >> 1 & 1, n >> 2) ? 1 : 0;
                }
                for (int n = 0; n < 4; ++n) {  // two boxes at opposite corners, or all but these
                    const bool a = at(n & 1, n >> 1 & 1, 0);
                    const bool b = at(1 - (n & 1), 1 - (n >> 1 & 1), 1);
                    if ((count == 2 && a && b) || (count == 6 && !a && !b)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

/// A lattice point in units of 1 / fine of a box.
using Lattice = std::array<Index, 3>;

/// The solid with fine^3 small boxes in each voxel and six tetrahedra in each of them, and the lattice point of each
/// node. Neighbouring tetrahedra conform.
struct VoxelTets {
    pavior::TetMesh mesh;
    std::vector<Lattice> lattice;
};

inline VoxelTets tetrahedra(const Voxels& v, Index fine = 1) {
    VoxelTets out;
    const std::array<Index, 3> n{v.size[0] * fine + 1, v.size[1] * fine + 1, v.size[2] * fine + 1};
    std::vector<Index> id(std::size_t{n[0]} * n[1] * n[2], pavior::no_index);
    const auto node = [&](const Lattice& x) {
        Index& i = id[(std::size_t{x[2]} * n[1] + x[1]) * n[0] + x[0]];
        if (i == pavior::no_index) {
            i = static_cast<Index>(out.lattice.size());
            out.lattice.push_back(x);
            out.mesh.nodes.push_back(Vec3(x[0], x[1], x[2]) / fine);
        }
        return i;
    };
    constexpr std::array<std::array<std::size_t, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (Index k = 0; k + 1 < n[2]; ++k) {
        for (Index j = 0; j + 1 < n[1]; ++j) {
            for (Index i = 0; i + 1 < n[0]; ++i) {
                if (!v(static_cast<int>(i / fine), static_cast<int>(j / fine), static_cast<int>(k / fine))) {
                    continue;
                }
                for (std::size_t o = 0; o < 6; ++o) {
                    Lattice x{i, j, k};
                    TetCorners c{node(x), 0, 0, 0};
                    for (std::size_t s = 0; s < 3; ++s) {
                        ++x[orders[o][s]];
                        c[s + 1] = node(x);
                    }
                    if (o >= 3) {
                        std::swap(c[2], c[3]);
                    }
                    out.mesh.tets.push_back(c);
                }
            }
        }
    }
    return out;
}

/// Faces of the tetrahedra on the lattice plane x[axis] = at (in small boxes), inner ones only.
inline void add_plane(const VoxelTets& v, const pavior::TetTopology& topology, std::size_t axis, Index at,
                      pavior::ReferenceMesh& mesh) {
    for (Index f = 0; f < topology.faces.size(); ++f) {
        const auto& c = topology.faces[f];
        if (!topology.boundary(f) && v.lattice[c[0]][axis] == at && v.lattice[c[1]][axis] == at &&
            v.lattice[c[2]][axis] == at) {
            mesh.layers.push_back(c);
        }
    }
}

/// The reference mesh of a voxel solid with all voxel sides as layers.
inline pavior::ReferenceMesh reference(const Voxels& v, Index fine = 1, bool cut = true) {
    const VoxelTets tets = tetrahedra(v, fine);
    const pavior::TetTopology topology = pavior::tet_topology(tets.mesh);
    pavior::ReferenceMesh mesh = pavior::make_reference_mesh(tets.mesh, topology);
    for (std::size_t axis = 0; axis < 3 && cut; ++axis) {
        for (Index at = 1; at < v.size[axis]; ++at) {
            add_plane(tets, topology, axis, at * fine, mesh);
        }
    }
    return mesh;
}

/// A random connected solid of about half the voxels of a box, without non-manifold edges and nodes.
inline Voxels random_solid(std::array<Index, 3> size, std::mt19937& random) {
    while (true) {
        Voxels v{size, std::vector<char>(std::size_t{size[0]} * size[1] * size[2], 0)};
        const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
        const std::size_t wanted = 1 + below(v.inside.size());
        std::vector<Lattice> grown{{below(size[0]), below(size[1]), below(size[2])}};
        for (std::size_t n = 0; n < grown.size() && grown.size() < 4 * wanted; ++n) {
            const Lattice x = grown[below(grown.size())];
            v.inside[(std::size_t{x[2]} * size[1] + x[1]) * size[0] + x[0]] = 1;
            Lattice y = x;
            const std::size_t axis = below(3);
            y[axis] += below(2) == 0 ? 1U : pavior::no_index;
            grown.push_back(y[axis] < size[axis] ? y : x);
        }
        if (manifold(v)) {
            return v;
        }
    }
}

/// Vertices, edges, faces and cells of the voxel complex.
inline std::array<std::size_t, 4> strata(const Voxels& v) {
    std::array<std::size_t, 4> count{};
    const std::array<int, 3> n{static_cast<int>(v.size[0]), static_cast<int>(v.size[1]), static_cast<int>(v.size[2])};
    for (int k = 0; k <= 2 * n[2]; ++k) {
        for (int j = 0; j <= 2 * n[1]; ++j) {
            for (int i = 0; i <= 2 * n[0]; ++i) {
                bool used = false;  // odd coordinates: middle of a voxel
                for (int m = 0; m < 8; ++m) {
                    const auto side = [&](int x, int bit) { return x % 2 != 0 ? x / 2 : x / 2 - (m >> bit & 1); };
                    used = used || v(side(i, 0), side(j, 1), side(k, 2));
                }
                count[static_cast<std::size_t>(i % 2 + j % 2 + k % 2)] += used ? 1 : 0;
            }
        }
    }
    return count;
}

/// A file of tests/data/block.
struct ReferenceFile {
    pavior::ReferenceMesh mesh;
    nlohmann::json expected;
};

inline ReferenceFile read_reference(const std::string& name) {
    std::ifstream file(std::string(PAVIOR_TEST_DATA) + "/block/" + name + ".json");
    const nlohmann::json json = nlohmann::json::parse(file);
    pavior::TetMesh tets;
    for (const auto& p : json.at("points")) {
        tets.nodes.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    for (const auto& t : json.at("tets")) {
        auto c = t.get<TetCorners>();
        const Vec3 x = tets.nodes[c[0]];
        if ((tets.nodes[c[1]] - x).cross(tets.nodes[c[2]] - x).dot(tets.nodes[c[3]] - x) < 0.0) {
            std::swap(c[2], c[3]);  // the files are not oriented
        }
        tets.tets.push_back(c);
    }
    ReferenceFile result{pavior::make_reference_mesh(tets), json.at("expected")};
    for (const auto& f : json.at("layer_faces")) {
        result.mesh.layers.push_back(f.get<pavior::TriCorners>());
    }
    return result;
}

}  // namespace tet_meshes

namespace archetype {

/// Reference mesh that can be neither copied nor default-constructed; ranges are made anew at each call.
class Tets {
public:
    explicit Tets(pavior::ReferenceMesh mesh) : mesh_(std::move(mesh)) {}
    Tets(const Tets&) = delete;
    Tets& operator=(const Tets&) = delete;
    [[nodiscard]] const pavior::ReferenceMesh& get() const { return mesh_; }

private:
    pavior::ReferenceMesh mesh_;
};
}  // namespace archetype

template <>
struct pavior::mesh_access<archetype::Tets> {
    static unsigned node_count(const archetype::Tets& m) { return static_cast<unsigned>(m.get().nodes.size()); }
    static archetype::Point node(const archetype::Tets& m, Index i) { return archetype::Point(m.get().nodes[i]); }
    static unsigned tet_count(const archetype::Tets& m) { return static_cast<unsigned>(m.get().tets.size()); }
    static archetype::Corners tet(const archetype::Tets& m, Index t) {
        return archetype::Corners(m.get().tets[t].data());
    }
};

template <>
struct pavior::feature_access<archetype::Tets> {
    static auto patches(const archetype::Tets& m) { return m.get().patches; }
    static auto curves(const archetype::Tets& m) { return m.get().curves; }
    static auto vertices(const archetype::Tets& m) { return m.get().vertices; }
    static auto layers(const archetype::Tets& m) { return m.get().layers; }
};

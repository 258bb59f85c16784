#pragma once
// Reference meshes for the tests of blocks.

#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace block_cases {

using pavior::Index;
using pavior::Vec3;

/// A reference mesh and all that the dual room makes of it.
struct Case {
    pavior::ReferenceMesh mesh;
    pavior::TetTopology topology;
    pavior::EntityClasses classes;
    pavior::CellComplex complex;
};

inline Case complete(pavior::ReferenceMesh mesh) {
    Case c{std::move(mesh), {}, {}, {}};
    c.topology = pavior::tet_topology(c.mesh);
    c.classes = pavior::classify(c.mesh, c.topology);
    c.complex = pavior::cell_complex(c.mesh, c.topology, c.classes);
    return c;
}

/// A mesh of tests/data/block with its layers.
inline Case read(const std::string& name) {
    std::ifstream file(std::string(PAVIOR_TEST_DATA) + "/block/" + name + ".json");
    const nlohmann::json json = nlohmann::json::parse(file);
    pavior::TetMesh tets;
    for (const auto& p : json.at("points")) {
        tets.nodes.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    for (const auto& t : json.at("tets")) {
        auto c = t.get<std::array<Index, 4>>();
        const Vec3& x = tets.nodes[c[0]];
        const Vec3 normal = (tets.nodes[c[1]] - x).cross(tets.nodes[c[2]] - x);
        if (normal.dot(tets.nodes[c[3]] - x) < 0.0) {  // the files do not care about the orientation
            std::swap(c[2], c[3]);
        }
        tets.tets.push_back(c);
    }
    pavior::ReferenceMesh mesh = pavior::make_reference_mesh(tets);
    for (const auto& f : json.at("layer_faces")) {
        mesh.layers.push_back(f.get<std::array<Index, 3>>());
    }
    return complete(std::move(mesh));
}

/// Grid of m[0] x m[1] x m[2] boxes over [0, 1]^3, six tetrahedra each, bent by \p bend; a cut at each lattice plane
/// whose number is in \p cuts (axis, number).
template <class Bend>
Case grid(std::array<Index, 3> m, const std::vector<std::array<Index, 2>>& cuts, const Bend& bend) {
    pavior::TetMesh tets;
    const auto at = [&](Index i, Index j, Index k) { return (k * (m[1] + 1) + j) * (m[0] + 1) + i; };
    for (Index k = 0; k <= m[2]; ++k) {
        for (Index j = 0; j <= m[1]; ++j) {
            for (Index i = 0; i <= m[0]; ++i) {
                tets.nodes.push_back(Vec3(double(i) / m[0], double(j) / m[1], double(k) / m[2]));
            }
        }
    }
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (Index k = 0; k < m[2]; ++k) {
        for (Index j = 0; j < m[1]; ++j) {
            for (Index i = 0; i < m[0]; ++i) {
                for (std::size_t o = 0; o < 6; ++o) {
                    std::array<Index, 3> x{i, j, k};
                    std::array<Index, 4> c{};
                    c[0] = at(x[0], x[1], x[2]);
                    for (std::size_t s = 0; s < 3; ++s) {
                        ++x[static_cast<std::size_t>(orders[o][s])];
                        c[s + 1] = at(x[0], x[1], x[2]);
                    }
                    if (o >= 3) {
                        std::swap(c[2], c[3]);
                    }
                    tets.tets.push_back(c);
                }
            }
        }
    }
    const std::vector<Vec3> flat = tets.nodes;
    for (Vec3& x : tets.nodes) {
        x = bend(x);
    }
    pavior::ReferenceMesh mesh = pavior::make_reference_mesh(tets);
    const pavior::TetTopology topology = pavior::tet_topology(tets);
    for (Index f = 0; f < topology.faces.size(); ++f) {
        for (const auto& cut : cuts) {
            const double wanted = double(cut[1]) / m[cut[0]];
            bool on = !topology.boundary(f);
            for (const Index i : topology.faces[f]) {
                on = on && std::abs(flat[i][static_cast<Eigen::Index>(cut[0])] - wanted) < 1e-9;
            }
            if (on) {
                mesh.layers.push_back(topology.faces[f]);
            }
        }
    }
    return complete(std::move(mesh));
}

inline Case box(std::array<Index, 3> m, const std::vector<std::array<Index, 2>>& cuts = {}) {
    return grid(m, cuts, [](const Vec3& x) { return x; });
}

}  // namespace block_cases

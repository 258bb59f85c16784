#include "saved_model.hpp"

#include "gmsh_import.hpp"

#include <algorithm>
#include <cmath>

namespace pavior::detail {

namespace {

bool same_face(const FaceData& a, const FaceData& b) {
    const double same = 1e-6 * (a.bounds[1] - a.bounds[0]).norm();
    return a.tag == b.tag && a.kind == b.kind && a.loops == b.loops && a.chains.size() == b.chains.size() &&
           std::abs(a.area - b.area) <= 1e-6 * a.area && (a.bounds[0] - b.bounds[0]).norm() <= same &&
           (a.bounds[1] - b.bounds[1]).norm() <= same;
}

/// Whether two models are the same, tags included.
bool same_topology(const Topology& a, const Topology& b) {
    const double same = 1e-9 * a.diagonal;
    const auto same_vertex = [&](const Vec3& x, const Vec3& y) { return (x - y).norm() <= same; };
    const auto same_edge = [&](const EdgeData& x, const EdgeData& y) {
        return x.tag == y.tag && x.vertices == y.vertices && std::abs(x.length - y.length) <= 1e-6 * x.length;
    };
    const auto same_solid = [](const SolidData& x, const SolidData& y) { return x.tag == y.tag && x.faces == y.faces; };
    const auto equal = [](const auto& x, const auto& y, const auto& test) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(), test);
    };
    return a.vertex_tags == b.vertex_tags && equal(a.vertices, b.vertices, same_vertex) &&
           equal(a.edges, b.edges, same_edge) &&
           equal(a.faces, b.faces, [](const auto& x, const auto& y) { return same_face(x, y); }) &&
           equal(a.solids, b.solids, same_solid);
}

}  // namespace

bool save_model(const std::filesystem::path& file, const Topology& topology) {
    gmsh::write(file.string());
    const GmshModel copy;
    const GmshModel::Current current(copy);
    import_file(file);
    return same_topology(topology, read_topology(copy));
}

}  // namespace pavior::detail

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

}  // namespace

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

Topology save_model(const std::filesystem::path& file) {
    gmsh::write(file.string());
    const GmshModel copy;
    const GmshModel::Current current(copy);
    import_file(file);
    return read_topology(copy);
}

std::map<int, std::size_t> match_solids(const Topology& copy, const Topology& original) {
    const auto middle = [](const Topology& t, const SolidData& solid) {
        Vec3 sum = Vec3::Zero();
        double count = 0;
        for (const OrientedFace& f : solid.faces) {
            for (const EdgeLoop& loop : t.faces[f.face.index()].loops) {
                for (const OrientedEdge& use : loop) {
                    for (const VertexId v : t.edges[use.edge.index()].vertices) {
                        sum += t.vertices[v.index()];
                        ++count;
                    }
                }
            }
        }
        return Vec3(sum / std::max(count, 1.0));
    };
    std::map<int, std::size_t> result;
    std::vector<bool> used(original.solids.size(), false);
    for (const SolidData& solid : copy.solids) {
        for (std::size_t i = 0; i < used.size(); ++i) {
            const SolidData& other = original.solids[i];
            if (!used[i] && other.faces.size() == solid.faces.size() &&
                std::abs(other.volume - solid.volume) <= 1e-6 * solid.volume &&
                (middle(original, other) - middle(copy, solid)).norm() <= 1e-6 * original.diagonal) {
                used[i] = true;
                result.emplace(solid.tag, i);
                break;
            }
        }
    }
    return result;
}

}  // namespace pavior::detail

#include <pavior/io/tet_mesh_file.hpp>

#include <pavior/core/error.hpp>

#include "../common/byte_arrays.hpp"
#include "../common/file_extension.hpp"
#include "read_apart.hpp"
#include "tet_mesh_formats.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace pavior {

namespace {

namespace fs = std::filesystem;

template <class Corners>
Corners ascending(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// One face of a tetrahedron: its nodes ascending, and as seen from outside.
struct Face {
    TriCorners key{};
    TriCorners outward{};
};

/// Makes sound data of what a file holds, or says what is wrong with it.
class Finisher {
public:
    Finisher(const std::string& file, io::RawTetMesh raw) : file_(file), raw_(std::move(raw)) {}

    TetMeshData run() {
        if (raw_.tets.cells.empty()) {
            throw FileError(file_, "holds no tetrahedra");
        }
        check_corners(raw_.tets);
        check_corners(raw_.triangles);
        check_corners(raw_.lines);
        check_corners(raw_.points);
        number_nodes();
        take_tets();
        take_triangles();
        take_lines();
        take_points();
        return std::move(data_);
    }

private:
    [[noreturn]] void fail(const std::string& message, std::int64_t name) const {
        throw FileError(file_, "cell " + std::to_string(name) + " " + message, {name});
    }

    template <class Corners>
    void check_corners(const io::TaggedCells<Corners>& cells) const {
        for (std::size_t i = 0; i < cells.cells.size(); ++i) {
            const Corners c = ascending(cells.cells[i]);
            if (c.back() >= raw_.nodes.size()) {
                fail("names a node that does not exist", cells.names[i]);
            }
            if (std::adjacent_find(c.begin(), c.end()) != c.end()) {
                fail("names a node twice", cells.names[i]);
            }
        }
    }

    /// Nodes of tetrahedra, in their order.
    void number_nodes() {
        number_.assign(raw_.nodes.size(), no_index);
        for (const TetCorners& c : raw_.tets.cells) {
            for (const Index node : c) {
                number_[node] = 0;
            }
        }
        for (std::size_t i = 0; i < number_.size(); ++i) {
            if (number_[i] == no_index) {
                continue;
            }
            if (!raw_.nodes[i].allFinite()) {
                throw FileError(file_, "node " + std::to_string(i) + " has a coordinate that is not finite",
                                {static_cast<std::int64_t>(i)});
            }
            number_[i] = static_cast<Index>(data_.tets.mesh.nodes.size());
            data_.tets.mesh.nodes.push_back(raw_.nodes[i]);
        }
    }

    template <class Corners>
    [[nodiscard]] Corners renumbered(Corners corners) const {
        for (Index& node : corners) {
            node = number_[node];
        }
        return corners;
    }

    void take_tets() {
        const std::vector<Vec3>& x = data_.tets.mesh.nodes;
        for (std::size_t t = 0; t < raw_.tets.cells.size(); ++t) {
            TetCorners c = renumbered(raw_.tets.cells[t]);
            const double six = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(x[c[3]] - x[c[0]]);
            if (six == 0.0) {
                fail("is a tetrahedron without volume", raw_.tets.names[t]);
            }
            if (six < 0.0) {
                std::swap(c[2], c[3]);
            }
            data_.tets.mesh.tets.push_back(c);
        }
        data_.tet_tags = raw_.tets.tags;
    }

    void take_triangles() {
        collect_faces();
        std::vector<std::int32_t> tags(faces_.size(), 0);
        for (std::size_t i = 0; i < raw_.triangles.cells.size(); ++i) {
            const TriCorners& given = raw_.triangles.cells[i];
            const auto [first, last] = find(given);
            if (first == last) {
                fail("is a triangle that is no face of a tetrahedron", raw_.triangles.names[i]);
            }
            if (last - first == 2) {
                data_.walls.push_back({renumbered(given), raw_.triangles.tags[i]});
            } else {
                tags[first] = raw_.triangles.tags[i];
            }
        }
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const bool with_last = f > 0 && faces_[f].key == faces_[f - 1].key;
            const bool with_next = f + 1 < faces_.size() && faces_[f].key == faces_[f + 1].key;
            if (with_last && with_next) {
                throw FileError(file_, "a face of more than two tetrahedra");
            }
            if (!with_last && !with_next) {
                data_.tets.triangles.push_back({faces_[f].outward, tags[f]});
            }
        }
    }

    void collect_faces() {
        faces_.reserve(4 * data_.tets.mesh.tets.size());
        for (const TetCorners& c : data_.tets.mesh.tets) {
            for (const auto& local : tet_faces) {
                const TriCorners face{c[static_cast<std::size_t>(local[0])], c[static_cast<std::size_t>(local[1])],
                                      c[static_cast<std::size_t>(local[2])]};
                faces_.push_back({ascending(face), face});
            }
        }
        std::stable_sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
    }

    /// The range of faces_ on these nodes of the file.
    [[nodiscard]] std::pair<std::size_t, std::size_t> find(const TriCorners& given) const {
        const TriCorners key = ascending(renumbered(given));
        const auto less = [](const Face& a, const Face& b) { return a.key < b.key; };
        const auto [first, last] = std::equal_range(faces_.begin(), faces_.end(), Face{key, {}}, less);
        return {static_cast<std::size_t>(first - faces_.begin()), static_cast<std::size_t>(last - faces_.begin())};
    }

    void take_lines() {
        if (raw_.lines.cells.empty()) {
            return;
        }
        std::vector<std::array<Index, 2>> known;
        known.reserve(3 * faces_.size());
        for (const Face& face : faces_) {
            known.insert(known.end(),
                         {{face.key[0], face.key[1]}, {face.key[0], face.key[2]}, {face.key[1], face.key[2]}});
        }
        std::sort(known.begin(), known.end());
        for (std::size_t i = 0; i < raw_.lines.cells.size(); ++i) {
            const auto nodes = renumbered(raw_.lines.cells[i]);
            if (!std::binary_search(known.begin(), known.end(), ascending(nodes))) {
                fail("is a line that is no edge of a tetrahedron", raw_.lines.names[i]);
            }
            data_.tets.edges.push_back({nodes, raw_.lines.tags[i]});
        }
    }

    void take_points() {
        for (std::size_t i = 0; i < raw_.points.cells.size(); ++i) {
            const Index node = number_[raw_.points.cells[i][0]];
            if (node == no_index) {
                fail("is a point that is no node of a tetrahedron", raw_.points.names[i]);
            }
            data_.tets.vertices.push_back({node, raw_.points.tags[i]});
        }
    }

    const std::string& file_;
    io::RawTetMesh raw_;
    TetMeshData data_;
    std::vector<Index> number_;
    std::vector<Face> faces_;
};

/// Calls visit(array) for each array of a mesh.
template <class Mesh, class Visit>
void for_arrays(Mesh& mesh, Visit&& visit) {
    visit(mesh.nodes);
    const auto visit_cells = [&](auto& cells) {
        visit(cells.cells);
        visit(cells.tags);
        visit(cells.names);
    };
    visit_cells(mesh.tets);
    visit_cells(mesh.triangles);
    visit_cells(mesh.lines);
    visit_cells(mesh.points);
}

}  // namespace

bool can_read_tet_mesh(std::string_view file) {
    const std::string ext = detail::file_extension(file);
    return ext == ".vtk" || ext == ".vtu" || ext == ".msh";
}

TetMeshData read_tet_mesh_data(const std::string& file) {
    if (!can_read_tet_mesh(file)) {
        throw FileError(file, "unknown format of tetrahedra; known are .vtk .vtu .msh");
    }
    std::error_code error;
    if (!fs::exists(file, error)) {
        throw FileError(file, "no such file");
    }
    if (fs::is_directory(file, error)) {
        throw FileError(file, "is a directory");
    }
    const std::string ext = detail::file_extension(file);
    const std::string bytes = io::read_apart(file, [&](detail::ByteWriter& writer) {
        const io::RawTetMesh raw = ext == ".msh" ? io::read_gmsh_tets(file) : io::read_vtk_tets(file, ext == ".vtu");
        for_arrays(raw, [&](const auto& array) { writer.add(array); });
    });
    detail::ByteReader reader(bytes);
    io::RawTetMesh raw;
    for_arrays(raw, [&](auto& array) { reader.get(array); });
    return Finisher(file, std::move(raw)).run();
}

}  // namespace pavior

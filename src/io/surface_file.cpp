#include <pavior/io/surface_file.hpp>

#include <pavior/core/error.hpp>
#include <pavior/mesh/near_nodes.hpp>

#include "../common/file_extension.hpp"
#include "surface_formats.hpp"
#include "surface_polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace pavior {

namespace {

namespace fs = std::filesystem;

std::string contents(const std::string& file) {
    std::error_code error;
    if (!fs::exists(file, error)) {
        throw FileError(file, "no such file");
    }
    if (fs::is_directory(file, error)) {
        throw FileError(file, "is a directory");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream && !stream.eof()) {
        throw FileError(file, "cannot be read");
    }
    if (text.empty()) {
        throw FileError(file, "empty");
    }
    return text;
}

/// The node that each node becomes: the first one in the same place.
std::vector<Index> weld_equal(const std::vector<Vec3>& nodes) {
    std::vector<Index> order(nodes.size());
    std::vector<Index> target(nodes.size());
    for (Index i = 0; i < order.size(); ++i) {
        order[i] = target[i] = i;
    }
    const auto key = [&](Index i) { return std::array{nodes[i].x(), nodes[i].y(), nodes[i].z()}; };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const auto x = key(a);
        const auto y = key(b);
        return x != y ? x < y : a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (key(order[i]) == key(order[i - 1])) {
            target[order[i]] = target[order[i - 1]];
        }
    }
    return target;
}

std::vector<Index> weld(const std::vector<Vec3>& nodes, double distance) {
    std::vector<Index> target = weld_equal(nodes);
    if (distance < 0.0) {
        for (Index i = 0; i < target.size(); ++i) {
            target[i] = i;
        }
    } else if (distance > 0.0) {
        for (const auto& [node, earlier] : near_nodes(nodes, distance)) {  // ascending: the earlier one is settled
            target[node] = target[earlier];
        }
    }
    return target;
}

/// Puts nodes and triangles into their final form.
TaggedSurface finish(const std::string& file, const io::PolygonSoup& soup, double weld_distance) {
    const std::vector<Index> target = weld(soup.nodes, weld_distance);
    TaggedSurface surface;
    std::vector<TriCorners> pieces;
    for (std::size_t f = 0; f < soup.face_count(); ++f) {
        pieces.clear();
        std::vector<Index> corners;
        for (std::size_t i = soup.offsets[f]; i < soup.offsets[f + 1]; ++i) {
            const Index node = target[soup.corners[i]];
            if (corners.empty() || corners.back() != node) {
                corners.push_back(node);
            }
        }
        while (corners.size() > 1 && corners.front() == corners.back()) {
            corners.pop_back();
        }
        io::cut_polygon(soup.nodes, corners, pieces);
        for (const TriCorners& c : pieces) {
            if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
                surface.mesh.triangles.push_back(c);
                surface.face_tags.push_back(soup.tags[f]);
            }
        }
    }
    if (surface.mesh.triangles.empty()) {
        throw FileError(file, "holds no triangles");
    }
    const auto& tags = surface.face_tags;
    if (std::all_of(tags.begin(), tags.end(), [](std::int32_t tag) { return tag == 0; })) {
        surface.face_tags.clear();
    }
    for (std::size_t k = 0; k < soup.names.size() && !surface.face_tags.empty(); ++k) {
        if (!soup.names[k].empty()) {
            surface.face_names[static_cast<std::int32_t>(k) + 1] = soup.names[k];
        }
    }
    std::vector<char> used(soup.nodes.size(), 0);
    for (const TriCorners& c : surface.mesh.triangles) {
        for (const Index node : c) {
            used[node] = 1;
        }
    }
    std::vector<Index> number(soup.nodes.size(), 0);
    for (Index i = 0; i < soup.nodes.size(); ++i) {
        if (used[i] != 0) {
            number[i] = static_cast<Index>(surface.mesh.nodes.size());
            surface.mesh.nodes.push_back(soup.nodes[i]);
        }
    }
    for (TriCorners& c : surface.mesh.triangles) {
        c = {number[c[0]], number[c[1]], number[c[2]]};
    }
    return surface;
}

io::PolygonSoup read_soup(const std::string& file) {
    const std::string ext = detail::file_extension(file);
    const std::string text = contents(file);
    return ext == ".stl"   ? io::read_stl(file, text)
           : ext == ".obj" ? io::read_obj(file, text)
           : ext == ".off" ? io::read_off(file, text)
                           : io::read_ply(file, text);
}

}  // namespace

bool can_read_surface(std::string_view file) {
    const std::string ext = detail::file_extension(file);
    return ext == ".stl" || ext == ".obj" || ext == ".off" || ext == ".ply";
}

TaggedSurface read_surface(const std::string& file, const SurfaceReadOptions& options) {
    if (!can_read_surface(file)) {
        throw FileError(file, "unknown surface format; known are .stl .obj .off .ply");
    }
    if (!std::isfinite(options.weld_distance)) {
        throw InputError(ErrorCode::bad_option, "the weld distance must be a finite number");
    }
    return finish(file, read_soup(file), options.weld_distance);
}

}  // namespace pavior

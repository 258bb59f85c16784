#include "gmsh_import.hpp"

#include "../common/bare_message.hpp"
#include "../common/child_process.hpp"
#include "../common/file_extension.hpp"
#include "gmsh_options.hpp"
#include "step_names.hpp"

#include <pavior/core/stop.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace pavior::detail {

namespace {

gmsh::vectorpair entities(int dim) {
    gmsh::vectorpair list;
    gmsh::model::getEntities(list, dim);
    return list;
}

/// Turns loose faces that close into solids.
void sew_faces(const gmsh::vectorpair& shapes) {
    gmsh::vectorpair healed;
    gmsh::model::occ::healShapes(healed, shapes, 1e-6, false, false, false, true, true);
    gmsh::model::occ::synchronize();
}

/// Without the path that Gmsh puts in front, and without names that only say which translator wrote the file.
std::string plain_name(const std::string& label) {
    const std::size_t slash = label.rfind('/');
    const std::string last = slash == std::string::npos ? label : label.substr(slash + 1);
    return last.rfind("Open CASCADE ", 0) == 0 ? std::string() : last;
}

std::string physical_name(int dim, int tag) {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
    std::string name;
    for (const int group : groups) {
        gmsh::model::getPhysicalName(dim, group, name);
        if (!name.empty()) {
            return name;
        }
    }
    return {};
}

/// OpenCASCADE complains about the syntax, goes on with what it understood, and may never come back.
constexpr const char* syntax_mark = "ERR StepFile";

std::string syntax_fault(const std::string& said) {
    const std::size_t detail = said.find(':', said.find(syntax_mark));
    const std::size_t stop = said.find_first_of("*\n", detail);
    return "syntax errors in the file" + (detail == std::string::npos ? "" : said.substr(detail, stop - detail));
}

}  // namespace

std::string cad_format(const std::filesystem::path& file) {
    const std::string extension = file_extension(file);
    if (extension == ".step" || extension == ".stp") {
        return "step";
    }
    if (extension == ".iges" || extension == ".igs") {
        return "iges";
    }
    return extension == ".brep" ? "brep" : "";
}

void check_cad_file(const std::filesystem::path& file) {
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status)) {
        throw FileError(file.string(), "no such file");
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw FileError(file.string(), "not a regular file");
    }
    if (cad_format(file).empty()) {
        throw FileError(file.string(), "unknown ending; .step, .stp, .iges, .igs and .brep can be read");
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw FileError(file.string(), "cannot be opened");
    }
    if (stream.peek() == std::ifstream::traits_type::eof()) {
        throw FileError(file.string(), "empty");
    }
}

void import_file(const std::filesystem::path& file) {
    with_gmsh(
        [&] {
            gmsh::vectorpair shapes;
            gmsh::option::setNumber("Geometry.OCCImportLabels", 1);
            gmsh::model::occ::importShapes(file.string(), shapes, true, cad_format(file));
            gmsh::model::occ::synchronize();
            if (entities(3).empty() && !entities(2).empty()) {
                sew_faces(entities(2));
            }
            if (entities(3).empty()) {
                throw FileError(file.string(), entities(-1).empty() ? "no geometry in it" : "no solid in it");
            }
        },
        [&](const std::string& message) { throw FileError(file.string(), message); });
}

std::string try_reading(const std::filesystem::path& file, const std::function<std::string()>& task, double seconds,
                        const std::stop_token& stop) {
    using End = ChildAnswer::End;
    const auto fail = [](const std::string& message) { throw std::runtime_error(message); };
    const auto read = [&] { return with_gmsh(task, fail); };
    const auto heard_enough = [](const std::string& said) {
        return said.find(syntax_mark) != std::string::npos || said.size() > (1U << 20U);
    };
    ChildAnswer answer = run_in_child(read, {.seconds = seconds, .stop = stop, .heard_enough = heard_enough});
    if (answer.end == End::stopped) {
        throw Stopped();
    }
    if (answer.said.find(syntax_mark) != std::string::npos) {
        throw FileError(file.string(), syntax_fault(answer.said));
    }
    if (answer.end == End::timed_out) {
        std::ostringstream text;
        text << "the CAD kernel did not come back within " << seconds << " s";
        throw Error(ErrorCode::cad_failure, file.string() + ": " + text.str());
    }
    if (answer.end == End::died) {
        throw FileError(file.string(), "the CAD kernel " + answer.reason + " on it");
    }
    if (answer.end == End::threw) {
        throw FileError(file.string(), bare_message(file.string(), answer.reason));
    }
    return std::move(answer.bytes);
}

EntityNames read_names() {
    EntityNames names;
    for (const int dim : {2, 3}) {
        for (const auto& [d, tag] : entities(dim)) {
            std::string label;
            gmsh::model::getEntityName(d, tag, label);
            label = plain_name(label);
            if (label.empty()) {
                label = physical_name(d, tag);
            }
            if (!label.empty()) {
                names[{d, tag}] = label;
            }
        }
    }
    return names;
}

EntityNames read_names(const std::filesystem::path& file) {
    EntityNames names = read_names();
    if (cad_format(file) == "step") {
        std::ifstream stream(file, std::ios::binary);
        name_step_entities({std::istreambuf_iterator<char>(stream), {}}, names);
    }
    return names;
}

namespace {

/// The named face of the original model that contains the point, or 0. \p boxes are those of its faces.
int original_face(const GmshModel& original, const EntityNames& names, const std::map<int, Box<>>& boxes,
                  const Vec3& point, double tolerance) {
    for (const auto& [entity, name] : names) {
        Vec2 uv;
        if (entity.first != 2 || boxes.at(entity.second).square_distance(point) > tolerance * tolerance ||
            !original.project_on_face(entity.second, point, uv)) {
            continue;
        }
        std::array<Vec3, 1> there;
        original.face_points(entity.second, std::array{uv}, there);
        if ((there[0] - point).norm() <= tolerance && original.inside_face(entity.second, uv)) {
            return entity.second;
        }
    }
    return 0;
}

/// A point inside the face by trial on grids, away from its boundary if there is such a one: points of boundaries lie
/// on other faces, too.
bool point_inside(const GmshModel& model, int tag, Vec3& point) {
    const auto [low, high] = model.face_bounds(tag);
    const Vec2 size = high - low;
    const auto inside = [&](const Vec2& at, const Vec2& step) { return model.inside_face(tag, at + step); };
    for (const double margin : {0.2, 0.0}) {
        for (int grid = 2; grid <= 64; grid *= 2) {
            const Vec2 u(margin * size[0] / grid, 0);
            const Vec2 v(0, margin * size[1] / grid);
            for (int i = 0; i < grid * grid; ++i) {
                // Not in the middle of anything: corners are where other solids end.
                const Vec2 at = low + size.cwiseProduct(Vec2(i / grid + 0.46, i % grid + 0.57) / grid);
                if (inside(at, {0, 0}) && inside(at, u) && inside(at, -u) && inside(at, v) && inside(at, -v)) {
                    std::array<Vec3, 1> x;
                    model.face_points(tag, std::array{at}, x);
                    point = x[0];
                    return true;
                }
            }
        }
    }
    return false;
}

}  // namespace

EntityNames imprint_solids(const GmshModel& model, const std::function<void()>& populate,
                           const std::filesystem::path& file, double tolerance, SolidPieces* pieces_of) {
    const GmshModel::Current current(model);
    const EntityNames before = read_names(file);
    const gmsh::vectorpair solids = entities(3);
    gmsh::vectorpair pieces;
    std::vector<gmsh::vectorpair> map;
    SolidPieces own;
    for (const auto& solid : solids) {
        gmsh::model::occ::getMass(3, solid.second, own.volume[solid.second]);
    }
    {
        GmshOptions options;
        options.set("Geometry.ToleranceBoolean", tolerance);
        gmsh::model::occ::fragment(solids, {}, pieces, map);
        gmsh::model::occ::synchronize();
    }
    EntityNames after;
    for (const bool whole : {true, false}) {  // what is all of one solid bears its name, else that of the first
        for (std::size_t i = 0; i < solids.size(); ++i) {
            const auto name = before.find(solids[i]);
            for (const auto& piece : (map.at(i).size() == 1) == whole ? map.at(i) : gmsh::vectorpair{}) {
                if (name != before.end()) {
                    after.try_emplace(piece, name->second);
                }
                own.pieces[solids[i].second].push_back(piece.second);
            }
        }
    }
    if (pieces_of != nullptr) {
        *pieces_of = std::move(own);
    }
    if (std::any_of(before.begin(), before.end(), [](const auto& entry) { return entry.first.first == 2; })) {
        const GmshModel original;
        std::map<int, Box<>> boxes;
        {
            const GmshModel::Current there(original);
            populate();
            for (const auto& [dim, tag] : entities(2)) {
                boxes.emplace(tag, bounding_box(dim, tag));
            }
        }
        const double diagonal = bounding_box().extent().norm();
        for (const auto& face : entities(2)) {
            Vec3 point;
            if (point_inside(model, face.second, point)) {
                if (const int tag = original_face(original, before, boxes, point, 1e-6 * diagonal); tag != 0) {
                    after[face] = before.at({2, tag});
                }
            }
        }
    }
    return after;
}

}  // namespace pavior::detail

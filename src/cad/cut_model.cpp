#include <pavior/cad/cut_model.hpp>

#include "../common/file_extension.hpp"
#include "entities_at.hpp"
#include "gmsh_import.hpp"
#include "gmsh_topology.hpp"
#include "saved_model.hpp"
#include "scratch_folder.hpp"

#include <pavior/decompose/cut_lines.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace pavior {

namespace {

namespace occ = gmsh::model::occ;

/// By tag of a solid: the position of what it was in the model before any cut.
using Origins = std::map<int, std::size_t>;

gmsh::vectorpair all_entities(int dim) {
    gmsh::vectorpair list;
    gmsh::model::getEntities(list, dim);
    return list;
}

/// Makes the faces of surfaces in the current model, large enough to reach through it.
class SurfaceMaker {
public:
    explicit SurfaceMaker(const Box<>& box) : middle_(0.5 * (box.low + box.high)), reach_(box.extent().norm()) {}

    gmsh::vectorpair operator()(const CutPlane& plane) const {
        const Vec3 centre = middle_ - (middle_ - plane.point).dot(plane.normal) * plane.normal;
        const Vec3 x = reach_ * plane.normal.unitOrthogonal();
        const Vec3 y = plane.normal.cross(x);
        return polygon({centre - x - y, centre + x - y, centre + x + y, centre - x + y});
    }
    gmsh::vectorpair operator()(const CutHalfPlane& plane) const {
        const Vec3 centre = plane.point + (middle_ - plane.point).dot(plane.along) * plane.along;
        const Vec3 x = reach_ * plane.along;
        const Vec3 y = (reach_ + (middle_ - centre).norm()) * plane.into;
        return polygon({centre - x, centre + x, centre + x + y, centre - x + y});
    }
    gmsh::vectorpair operator()(const CutCylinder& cylinder) const {
        const Vec3 d = cylinder.direction.normalized();
        const Vec3 low = cylinder.point + ((middle_ - cylinder.point).dot(d) - reach_) * d;
        const int circle = occ::addCircle(0, 0, 0, cylinder.radius);
        const gmsh::vectorpair edge{{1, circle}};
        Eigen::Matrix3d frame;
        frame << cylinder.seam.normalized(), d.cross(cylinder.seam).normalized(), d;
        const Eigen::AngleAxisd turn(frame);
        occ::rotate(edge, 0, 0, 0, turn.axis()[0], turn.axis()[1], turn.axis()[2], turn.angle());
        occ::translate(edge, low[0], low[1], low[2]);
        gmsh::vectorpair made;
        occ::extrude(edge, 2 * reach_ * d[0], 2 * reach_ * d[1], 2 * reach_ * d[2], made);
        std::erase_if(made, [](const auto& entity) { return entity.first != 2; });
        return made;
    }

private:
    static gmsh::vectorpair polygon(const std::array<Vec3, 4>& corners) {
        std::vector<int> points;
        std::vector<int> lines;
        for (const Vec3& x : corners) {
            points.push_back(occ::addPoint(x[0], x[1], x[2]));
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
        }
        return {{2, occ::addPlaneSurface({occ::addCurveLoop(lines)})}};
    }

    Vec3 middle_;
    double reach_;
};

/// Makes the line of a curve in the current model.
std::pair<int, int> make_curve(const CutCurve& curve) {
    const auto point = [](const Vec3& x) { return occ::addPoint(x[0], x[1], x[2]); };
    const std::optional<Vec3> centre = circle_centre(curve.from, curve.middle, curve.to);
    if (!centre) {
        return {1, occ::addLine(point(curve.from), point(curve.to))};
    }
    return {1, occ::addCircleArc(point(curve.from), point(*centre), point(curve.to))};
}

/// Cuts one solid of the current model by faces, and faces by curves; both are used up.
void fragment_solid(int solid, gmsh::vectorpair tools, const gmsh::vectorpair& curves, Origins& origins) {
    if (!tools.empty() && all_entities(3).size() > 1) {  // others stay whole
        gmsh::vectorpair inside;
        std::vector<gmsh::vectorpair> map;
        occ::intersect(tools, {{3, solid}}, inside, map, -1, true, false);
        std::erase_if(inside, [](const auto& entity) { return entity.first != 2; });
        tools = std::move(inside);
    }
    tools.insert(tools.end(), curves.begin(), curves.end());
    occ::synchronize();
    const gmsh::vectorpair solids = all_entities(3);
    gmsh::vectorpair pieces;
    std::vector<gmsh::vectorpair> map;
    occ::fragment(solids, tools, pieces, map);
    occ::synchronize();
    Origins after;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        for (const auto& piece : map.at(i)) {
            after.emplace(piece.second, origins.at(solids[i].second));
        }
    }
    origins = std::move(after);
    for (const int dim : {2, 1, 0}) {  // what of the tools bounds no solid
        for (const auto& entity : all_entities(dim)) {
            std::vector<int> above;
            std::vector<int> below;
            gmsh::model::getAdjacencies(dim, entity.second, above, below);
            if (above.empty()) {
                occ::remove({entity});
            }
        }
        occ::synchronize();
    }
}

}  // namespace

struct GmshCutter::Base {
    const GmshBrep& model;
    detail::ScratchFolder folder;
    std::map<int, std::size_t> solid_of_saved;        ///< solids of the model by tag in `file`
    std::filesystem::path file;                       ///< empty: the model could not be saved
    std::array<std::map<int, std::size_t>, 4> index;  ///< of the entities of the model, by dimension and Gmsh's tag

    explicit Base(const GmshBrep& b) : model(b) {
        for (std::size_t d = 0; d < 4; ++d) {
            for (std::size_t i = 0; i < counts(b)[d]; ++i) {
                index[d].emplace(b.gmsh_tag(static_cast<int>(d), i), i);
            }
        }
        if (folder.path().empty()) {
            return;
        }
        try {
            const detail::Hush hush;
            const detail::GmshModel::Current current(b.gmsh_model());
            const std::filesystem::path saved = folder.path() / "model.brep";
            solid_of_saved = detail::match_solids(detail::save_model(saved), b.topology());
            if (solid_of_saved.size() == b.solid_count()) {
                file = saved;
            }
        } catch (...) {  // no place for the file, or a model that it does not keep
        }
    }

    /// Puts the model into the current one, and cuts it.
    void make(std::span<const SolidCut> cuts, Origins& origins) const {
        detail::import_file(file);
        origins.clear();
        for (const auto& [dim, tag] : all_entities(3)) {
            origins.emplace(tag, solid_of_saved.at(tag));
        }
        const SurfaceMaker maker(detail::bounding_box());
        for (const SolidCut& cut : cuts) {
            const gmsh::vectorpair solids = all_entities(3);
            if (!cut.solid.valid() || cut.solid.index() >= solids.size()) {
                throw InputError(ErrorCode::bad_index,
                                 "there is no solid " + std::to_string(cut.solid.value) + " to cut", {cut.solid.value});
            }
            gmsh::vectorpair tools;
            for (const CutSurface& surface : cut.surfaces) {
                const gmsh::vectorpair faces = std::visit(maker, surface);
                tools.insert(tools.end(), faces.begin(), faces.end());
            }
            gmsh::vectorpair curves;
            for (const CutCurve& curve : cut.curves) {
                curves.push_back(make_curve(curve));
            }
            const std::size_t faces = all_entities(2).size();
            const bool whole = tools.empty();
            fragment_solid(solids[cut.solid.index()].second, std::move(tools), curves, origins);
            if (whole ? all_entities(2).size() <= faces : all_entities(3).size() <= solids.size()) {
                throw UnmeshableError(ErrorCode::cad_failure, "a cut divides nothing");
            }
        }
    }

    /// By index of an entity of the pieces: the index of that of the model that it lies on, if any.
    [[nodiscard]] std::array<std::vector<std::optional<std::size_t>>, 4> wholes(const GmshPieces& of) const {
        const GmshBrep& pieces = *of.model;
        const detail::EntitiesAt at(model.gmsh_model(), 1e-6 * model.diagonal());
        std::array<std::vector<std::optional<std::size_t>>, 4> result;
        const auto add = [&](std::size_t d, const Vec3& x) {
            std::optional<std::size_t> found;
            for (const int tag : at.at(static_cast<int>(d), x)) {
                const auto known = index[d].find(tag);
                found = found || known == index[d].end() ? found : std::optional(known->second);
            }
            result[d].push_back(found);
        };
        for (const Vec3& x : pieces.topology().vertices) {
            add(0, x);
        }
        for (std::size_t e = 0; e < pieces.edge_count(); ++e) {
            const EdgeId edge{static_cast<std::int32_t>(e)};
            const auto range = pieces.edge_range(edge);
            add(1, pieces.edge_point(edge, 0.5 * (range[0] + range[1])));
        }
        for (std::size_t f = 0; f < pieces.face_count(); ++f) {
            const FaceId face{static_cast<std::int32_t>(f)};
            add(2, pieces.face_point(face, pieces.face_interior(face)));
        }
        for (const SolidId whole : of.solid) {
            result[3].emplace_back(whole.index());
        }
        return result;
    }

    /// The tags of the pieces, as Topology::file_tags.
    [[nodiscard]] std::array<std::vector<std::vector<int>>, 4> tags(
        const std::array<std::vector<std::optional<std::size_t>>, 4>& whole) const {
        std::array<std::vector<std::vector<int>>, 4> result;
        for (std::size_t d = 0; d < 4; ++d) {
            const int dim = static_cast<int>(d);
            int last = 0;
            for (std::size_t i = 0; i < counts(model)[d]; ++i) {
                const std::vector<int> own = model.all_tags(dim, i);
                last = std::max(last, *std::max_element(own.begin(), own.end()));
            }
            std::set<int> used;
            for (const std::optional<std::size_t>& i : whole[d]) {
                std::vector<int> own = i ? model.all_tags(dim, *i) : std::vector<int>{};
                if (own.empty() || (dim < 2 && !used.insert(own.front()).second)) {
                    own.insert(own.begin(), ++last);
                }
                result[d].push_back(std::move(own));
            }
        }
        return result;
    }

    [[nodiscard]] static std::array<std::size_t, 4> counts(const GmshBrep& b) {
        return {b.vertex_count(), b.edge_count(), b.face_count(), b.solid_count()};
    }
};

GmshCutter::GmshCutter(const GmshBrep& model) : base_(std::make_shared<const Base>(model)) {}

std::optional<GmshPieces> GmshCutter::operator()(std::span<const SolidCut> cuts) const {
    constexpr double least_share = 2e-4;
    constexpr double least_thickness = 1e-3;
    const GmshBrep& model = base_->model;
    if (base_->file.empty()) {
        return std::nullopt;
    }
    Origins origins;
    CadOptions options;
    options.imprint = false;
    std::optional<GmshBrep> made;
    try {
        made = GmshBrep::build([&] { base_->make(cuts, origins); }, options);
    } catch (const InputError&) {
        throw;
    } catch (const Error&) {
        return std::nullopt;
    }
    GmshPieces result;
    std::vector<double> volume(model.solid_count(), 0);
    for (std::size_t s = 0; s < made->solid_count(); ++s) {
        const auto origin = origins.find(made->gmsh_tag(3, s));
        if (origin == origins.end()) {
            return std::nullopt;
        }
        const SolidId piece{static_cast<std::int32_t>(s)};
        const SolidId whole{static_cast<std::int32_t>(origin->second)};
        const double own = made->solid_volume(piece);
        double area = 0;
        for (const OrientedFace& f : made->solid_faces(piece)) {
            area += made->face_area(f.face);
        }
        if (!(own > least_share * model.solid_volume(whole)) || 2 * own < least_thickness * model.diagonal() * area) {
            return std::nullopt;
        }
        result.solid.push_back(whole);
        volume[whole.index()] += own;
    }
    for (std::size_t s = 0; s < volume.size(); ++s) {
        const double own = model.solid_volume(SolidId{static_cast<std::int32_t>(s)});
        if (std::abs(volume[s] - own) > 1e-4 * own) {
            return std::nullopt;
        }
    }
    result.model = std::make_shared<GmshBrep>(std::move(*made));
    return result;
}

std::vector<FaceId> GmshCutter::identify(GmshPieces& pieces) const {
    const auto whole = base_->wholes(pieces);
    std::vector<FaceId> faces;
    for (const std::optional<std::size_t>& face : whole[2]) {
        faces.push_back(face ? FaceId{static_cast<std::int32_t>(*face)} : FaceId{});
    }
    pieces.model->set_tags(base_->tags(whole));
    return faces;
}

void GmshCutter::save(std::span<const SolidCut> cuts, const std::filesystem::path& file) const {
    if (detail::file_extension(file) != ".brep") {
        throw FileError(file.string(), "pieces are written to files whose names end in .brep");
    }
    const std::optional<GmshPieces> pieces = (*this)(cuts);
    if (!pieces) {
        throw InputError(ErrorCode::bad_option, "these cuts give no pieces");
    }
    const std::filesystem::path saved = base_->folder.path() / "pieces.brep";
    {
        const detail::Hush hush;
        const detail::GmshModel::Current current(pieces->model->gmsh_model());
        detail::with_gmsh([&] { gmsh::write(saved.string()); },
                          [&](const std::string& message) { throw FileError(file.string(), message); });
    }
    std::error_code failure;  // Gmsh does not say what it cannot write
    std::filesystem::copy_file(saved, file, std::filesystem::copy_options::overwrite_existing, failure);
    if (failure) {
        throw FileError(file.string(), "it cannot be written: " + failure.message());
    }
}

}  // namespace pavior

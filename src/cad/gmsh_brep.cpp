#include <pavior/cad/gmsh_brep.hpp>

#include "gmsh_import.hpp"
#include "gmsh_topology.hpp"
#include "model_bytes.hpp"
#include "saved_model.hpp"
#include "scratch_folder.hpp"

#include <algorithm>

namespace pavior {

struct GmshBrep::Data {
    detail::GmshModel model;
    detail::Topology topology;
    ImprintReport report;

    [[nodiscard]] const detail::EdgeData& edge(EdgeId id) const { return topology.edges.at(id.index()); }
    [[nodiscard]] const detail::FaceData& face(FaceId id) const { return topology.faces.at(id.index()); }
    [[nodiscard]] const detail::SolidData& solid(SolidId id) const { return topology.solids.at(id.index()); }

    [[nodiscard]] const detail::EdgeUse& use(EdgeId edge_id, FaceId face_id, bool forward) const {
        const detail::EdgeUse* found = nullptr;
        for (const detail::EdgeUse& candidate : face(face_id).uses) {
            if (candidate.edge == edge_id && (found == nullptr || candidate.forward == forward)) {
                found = &candidate;
            }
        }
        if (found == nullptr) {
            throw InputError(ErrorCode::bad_index,
                             detail::entity_label(1, edge(edge_id).tag) + " does not bound " +
                                 detail::entity_label(2, face(face_id).tag),
                             {edge(edge_id).tag, face(face_id).tag});
        }
        return *found;
    }

    void read(const std::function<void()>& populate, const CadOptions& options, const std::filesystem::path& file) {
        const detail::GmshModel::Current current(model);
        populate();
        gmsh::vectorpair solids;
        gmsh::model::getEntities(solids, 3);
        const bool imprint = options.imprint && solids.size() > 1;
        detail::SolidPieces pieces;
        const detail::EntityNames names =
            imprint ? detail::imprint_solids(model, populate, file, options.imprint_tolerance, &pieces)
                    : detail::read_names(file);
        topology = detail::read_topology(model);
        if (imprint) {
            const double same = 1e-6 * topology.diagonal + options.imprint_tolerance;
            topology.file_tags = detail::file_tags(model, topology, pieces, populate, same);
            report = detail::imprint_report(model, topology, pieces, 1e-4 * topology.diagonal);
        }
        for (detail::FaceData& f : topology.faces) {
            const auto name = names.find({2, f.tag});
            f.name = name == names.end() ? std::string() : name->second;
        }
        for (detail::SolidData& s : topology.solids) {
            const auto name = names.find({3, s.tag});
            s.name = name == names.end() ? std::string() : name->second;
        }
    }

    /// Saves the model if solids were imprinted, which takes long, and returns what its file does not say; else, and
    /// where that does not work out, empty.
    [[nodiscard]] std::string imprint_saved(const std::filesystem::path& file) const {
        if (topology.file_tags[3].empty() || file.empty()) {
            return {};
        }
        try {
            const detail::GmshModel::Current current(model);
            return detail::same_topology(topology, detail::save_model(file))
                       ? detail::imprint_to_bytes(topology, report)
                       : std::string();
        } catch (...) {  // no place for the file, or a model that it does not keep
            return {};
        }
    }

    /// Reads what imprint_saved() saved and returned.
    void take(const std::filesystem::path& saved, const std::string& imprint) {
        const detail::GmshModel::Current current(model);
        detail::import_file(saved);
        topology = detail::read_topology(model);
        detail::imprint_from_bytes(imprint, topology, report);
    }
};

bool can_read_cad(const std::filesystem::path& file) { return !detail::cad_format(file).empty(); }

GmshBrep::GmshBrep(std::unique_ptr<Data> data) : data_(std::move(data)) {}
GmshBrep::GmshBrep(GmshBrep&&) noexcept = default;
GmshBrep& GmshBrep::operator=(GmshBrep&&) noexcept = default;
GmshBrep::~GmshBrep() = default;

void GmshBrep::set_tags(std::array<std::vector<std::vector<int>>, 4> tags) {
    data_->topology.file_tags = std::move(tags);
}

const detail::GmshModel& GmshBrep::gmsh_model() const { return data_->model; }
const detail::Topology& GmshBrep::topology() const { return data_->topology; }

GmshBrep GmshBrep::load(const std::filesystem::path& file, const CadOptions& options) {
    detail::check_cad_file(file);
    const auto populate = [&] { detail::import_file(file); };
    const detail::ScratchFolder folder;
    const std::filesystem::path saved = folder.path().empty() ? folder.path() : folder.path() / "imprinted.brep";
    std::string imprint;
    if (options.trial_seconds > 0) {
        const auto trial = [&] {
            const auto data = std::make_unique<Data>();
            data->read(populate, options, file);
            return data->imprint_saved(saved);
        };
        imprint = detail::try_reading(file, trial, options.trial_seconds, options.stop);
    }
    const detail::Hush hush;
    auto data = std::make_unique<Data>();
    const auto read = [&] {
        if (imprint.empty()) {
            data->read(populate, options, file);
        } else {
            data->take(saved, imprint);
        }
    };
    detail::with_gmsh(read, [&](const std::string& message) { throw FileError(file.string(), message); });
    return GmshBrep(std::move(data));
}

GmshBrep GmshBrep::build(const std::function<void()>& make_shapes, const CadOptions& options) {
    const detail::Hush hush;
    auto data = std::make_unique<Data>();
    const auto populate = [&] {
        make_shapes();
        gmsh::model::occ::synchronize();
    };
    detail::with_gmsh([&] { data->read(populate, options, {}); },
                      [](const std::string& message) { throw Error(ErrorCode::cad_failure, message); });
    if (data->topology.solids.empty()) {
        throw Error(ErrorCode::cad_failure, "no solid was built");
    }
    return GmshBrep(std::move(data));
}

std::size_t GmshBrep::vertex_count() const { return data_->topology.vertices.size(); }
std::size_t GmshBrep::edge_count() const { return data_->topology.edges.size(); }
std::size_t GmshBrep::face_count() const { return data_->topology.faces.size(); }
std::size_t GmshBrep::solid_count() const { return data_->topology.solids.size(); }

std::span<const OrientedFace> GmshBrep::solid_faces(SolidId solid) const { return data_->solid(solid).faces; }
std::span<const EdgeLoop> GmshBrep::face_loops(FaceId face) const { return data_->face(face).loops; }
std::array<VertexId, 2> GmshBrep::edge_vertices(EdgeId edge) const { return data_->edge(edge).vertices; }
Vec3 GmshBrep::vertex_point(VertexId vertex) const { return data_->topology.vertices.at(vertex.index()); }
std::array<double, 2> GmshBrep::edge_range(EdgeId edge) const { return data_->edge(edge).range; }
double GmshBrep::edge_length(EdgeId edge) const { return data_->edge(edge).length; }

Vec3 GmshBrep::edge_point(EdgeId edge, double t) const {
    std::array<Vec3, 1> point;
    edge_points(edge, std::array{t}, point);
    return point[0];
}

Vec3 GmshBrep::edge_derivative(EdgeId edge, double t) const {
    return data_->model.edge_derivative(data_->edge(edge).tag, t);
}

Vec3 GmshBrep::face_point(FaceId face, Vec2 uv) const {
    std::array<Vec3, 1> point;
    face_points(face, std::array{uv}, point);
    return point[0];
}

std::pair<Vec3, Vec3> GmshBrep::face_derivatives(FaceId face, Vec2 uv) const {
    const detail::FaceData& f = data_->face(face);
    std::array<std::array<Vec3, 2>, 1> derivatives;
    data_->model.face_derivatives(f.tag, std::array{detail::wrapped(f, uv)}, derivatives);
    return {derivatives[0][0], derivatives[0][1]};
}

Vec2 GmshBrep::closest_on_face(FaceId face, const Vec3& x) const {
    if (!x.allFinite()) {
        throw InputError(ErrorCode::not_finite, "the point to project is not finite");
    }
    return detail::closest_parameters(data_->model, data_->face(face), x);
}

Vec2 GmshBrep::edge_on_face(EdgeId edge, double t, FaceId face, bool forward) const {
    std::array<Vec2, 1> uv;
    edge_on_face(edge, std::array{t}, face, forward, uv);
    return uv[0];
}

std::array<double, 2> GmshBrep::face_period(FaceId face) const { return data_->face(face).period; }

const ImprintReport& GmshBrep::imprint_report() const { return data_->report; }

int GmshBrep::tag(int dim, std::size_t index) const {
    if (dim >= 0 && dim <= 3 && !data_->topology.file_tags[3].empty()) {
        return data_->topology.file_tags[static_cast<std::size_t>(dim)].at(index).front();
    }
    return gmsh_tag(dim, index);
}

std::vector<int> GmshBrep::all_tags(int dim, std::size_t index) const {
    if (dim >= 0 && dim <= 3 && !data_->topology.file_tags[3].empty()) {
        return data_->topology.file_tags[static_cast<std::size_t>(dim)].at(index);
    }
    return {gmsh_tag(dim, index)};
}

int GmshBrep::gmsh_tag(int dim, std::size_t index) const {
    switch (dim) {
        case 0: return data_->topology.vertex_tags.at(index);
        case 1: return data_->topology.edges.at(index).tag;
        case 2: return data_->topology.faces.at(index).tag;
        case 3: return data_->topology.solids.at(index).tag;
        default: throw InputError(ErrorCode::bad_index, "dimension " + std::to_string(dim) + " is not 0, 1, 2 or 3");
    }
}

std::optional<std::size_t> GmshBrep::find(int dim, int wanted) const {
    const std::array counts{vertex_count(), edge_count(), face_count(), solid_count()};
    if (dim < 0 || dim > 3) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dim)]; ++i) {
        if (tag(dim, i) == wanted) {
            return i;
        }
    }
    return std::nullopt;
}

const std::string& GmshBrep::solid_name(SolidId solid) const { return data_->solid(solid).name; }
const std::string& GmshBrep::face_name(FaceId face) const { return data_->face(face).name; }
const std::string& GmshBrep::face_kind(FaceId face) const { return data_->face(face).kind; }
std::array<Vec2, 2> GmshBrep::face_bounds(FaceId face) const { return data_->face(face).bounds; }
Vec2 GmshBrep::face_interior(FaceId face) const { return data_->face(face).interior; }
double GmshBrep::face_area(FaceId face) const { return data_->face(face).area; }
double GmshBrep::solid_volume(SolidId solid) const { return data_->solid(solid).volume; }
double GmshBrep::diagonal() const { return data_->topology.diagonal; }

void GmshBrep::face_points(FaceId face, std::span<const Vec2> uv, std::span<Vec3> points) const {
    const detail::FaceData& f = data_->face(face);
    if (!f.closed[0] && !f.closed[1]) {
        data_->model.face_points(f.tag, uv, points);
        return;
    }
    std::vector<Vec2> inside(uv.size());
    std::transform(uv.begin(), uv.end(), inside.begin(), [&](const Vec2& p) { return detail::wrapped(f, p); });
    data_->model.face_points(f.tag, inside, points);
}

void GmshBrep::edge_points(EdgeId edge, std::span<const double> t, std::span<Vec3> points) const {
    data_->model.edge_points(data_->edge(edge).tag, t, points);
}

void GmshBrep::edge_on_face(EdgeId edge, std::span<const double> t, FaceId face, bool forward,
                            std::span<Vec2> uv) const {
    detail::use_parameters(data_->model, data_->edge(edge), data_->face(face), data_->use(edge, face, forward), t, uv,
                           data_->topology.diagonal);
}

}  // namespace pavior

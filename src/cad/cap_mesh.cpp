#include <pavior/cad/cap_mesh.hpp>

#include "plane_quads.hpp"

#include <pavior/brep/face_surface.hpp>
#include <pavior/smooth/quads.hpp>
#include <pavior/smooth/surface_quads.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>

namespace pavior {

namespace {

using Matrix2 = Eigen::Matrix2d;

std::string face_label(const GmshBrep& model, FaceId face) {
    return "face " + std::to_string(model.tag(2, face.index()));
}

void check_boundary(const GmshBrep& model, FaceId face, const CapBoundary& boundary, const CapOptions& options) {
    const std::size_t n = boundary.points.size();
    const Error::Ids ids{model.tag(2, face.index())};
    const std::string label = face_label(model, face) + ": ";
    if (boundary.uv.size() != n || boundary.offsets.empty() || boundary.offsets.back() != n) {
        throw InputError(ErrorCode::size_mismatch, label + "points, parameters and loops do not agree", ids);
    }
    for (std::size_t l = 0; l + 1 < boundary.offsets.size(); ++l) {
        if (boundary.offsets[l + 1] < boundary.offsets[l] + 3) {
            throw InputError(ErrorCode::empty_input, label + "a loop has fewer than three nodes", ids);
        }
    }
    if (n < 4) {
        throw InputError(ErrorCode::empty_input, label + "fewer than four boundary nodes", ids);
    }
    if (n % 2 != 0) {
        throw InputError(ErrorCode::size_mismatch,
                         label + std::to_string(n) + " boundary nodes: quads need an even number", ids);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!boundary.points[i].allFinite() || !boundary.uv[i].allFinite()) {
            throw InputError(ErrorCode::not_finite, label + "a boundary node is not finite", ids);
        }
    }
    if (!(options.size >= 0) || !std::isfinite(options.size)) {
        throw InputError(ErrorCode::bad_option, "CapOptions::size must be finite and not negative");
    }
}

/// The linear map from parameters to a plane in which the face has, on average, its true lengths and angles.
Matrix2 flattening(const GmshBrep& model, FaceId face, const CapBoundary& boundary) {
    Matrix2 metric = Matrix2::Zero();
    const auto add = [&](const Vec2& uv) {
        const auto [du, dv] = model.face_derivatives(face, uv);
        metric += (Matrix2() << du.squaredNorm(), du.dot(dv), du.dot(dv), dv.squaredNorm()).finished();
    };
    for (const Vec2& uv : boundary.uv) {
        add(uv);
    }
    add(model.face_interior(face));
    const Eigen::LLT<Matrix2> cholesky(metric / static_cast<double>(boundary.uv.size() + 1));
    if (cholesky.info() != Eigen::Success) {
        throw Error(ErrorCode::cad_failure, face_label(model, face) + ": its parameters are degenerate",
                    {model.tag(2, face.index())});
    }
    return cholesky.matrixU();
}

double mean_spacing(const detail::PlaneLoops& loops) {
    double sum = 0;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; ++i) {
            sum += (loops.points[loops.next(l, i)] - loops.points[i]).norm();
        }
    }
    return sum / static_cast<double>(loops.points.size());
}

/// Twice the signed area of a loop.
double turn(const detail::PlaneLoops& loops, std::size_t l) {
    double twice = 0;
    for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; ++i) {
        const Vec2& a = loops.points[i];
        const Vec2& b = loops.points[loops.next(l, i)];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return twice;
}

/// The mesh of one face in the making: plane coordinates are `to_plane * (uv - origin)`, mean boundary spacing 1.
class CapMaker {
public:
    CapMaker(const GmshBrep& model, FaceId face, const CapBoundary& boundary, const CapOptions& options)
        : model_(model), face_(face), boundary_(boundary), options_(options) {
        to_plane_ = boundary.plane ? Matrix2(Matrix2::Identity()) : flattening(model, face, boundary);
        origin_ = boundary.uv.front();
        loops_.offsets = boundary.offsets;
        for (const Vec2& uv : boundary.uv) {
            loops_.points.emplace_back(to_plane_ * (uv - origin_));
        }
        const double spacing = mean_spacing(loops_);
        if (!(spacing > 0)) {
            throw InputError(ErrorCode::empty_input, face_label(model, face) + ": its boundary nodes coincide",
                             {model.tag(2, face.index())});
        }
        to_plane_ /= spacing;
        size_ = options.size / spacing;
        for (Vec2& point : loops_.points) {
            point /= spacing;
        }
        if (!(turn(loops_, 0) > 0)) {
            throw InputError(ErrorCode::bad_orientation,
                             face_label(model, face) + ": the outer loop does not run counter-clockwise",
                             {model.tag(2, face.index())});
        }
    }

    CapMesh make() {
        if (options_.structured) {
            consider(detail::grid_quads(loops_));
            failures_ = 0;
        }
        using Recipe = detail::QuadRecipe;
        for (const Recipe& recipe :
             {Recipe{6, 5, 1, 10}, Recipe{6, 0, 1, 10}, Recipe{5, 5, 1, 10}, Recipe{6, 5, 0.85, 10},
              Recipe{6, 5, 1.2, 10}, Recipe{5, 5, 0.8, 10}, Recipe{1, 5, 1, 10}, Recipe{6, 5, 0.7, 10}}) {
            if (best_quality_ < good && failures_ < allowed_failures) {
                consider(detail::recombined_quads(loops_, size_, recipe));
            }
        }
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
            if (best_quality_ > bad) {
                break;
            }
            const auto triangles = detail::subdivided_triangles(loops_, size_, first);
            consider(triangles);
            if (triangles && best_quality_ <= bad) {
                consider(detail::pillowed(*triangles, loops_));
            }
        }
        if (best_.quads.empty() || best_quality_ <= 0) {
            throw Error(
                ErrorCode::cad_failure,
                face_label(model_, face_) + (best_.quads.empty() ? ": no way to quads alone" : ": folded quads remain"),
                {model_.tag(2, face_.index())});
        }
        if (boundary_.plane) {
            for (std::size_t i = 0; i < best_.nodes.size(); ++i) {
                best_.uv[i] = model_.closest_on_face(face_, best_.nodes[i]);
            }
        }
        return std::move(best_);
    }

private:
    static constexpr double good = 0.4;
    static constexpr double bad = 0.05;
    static constexpr int allowed_failures = 4;

    void consider(const std::optional<detail::PlaneQuads>& plane) {
        if (!plane) {
            ++failures_;
            return;
        }
        CapMesh mesh;
        mesh.quads = plane->quads;
        const bool flat = boundary_.plane || model_.face_kind(face_) == "Plane";
        const double quality = flat ? flat_quality(*plane, mesh) : curved_quality(*plane, mesh);
        if (best_.quads.empty() || quality > best_quality_) {
            best_ = std::move(mesh);
            best_quality_ = quality;
        }
    }

    [[nodiscard]] std::vector<std::uint8_t> fixed(std::size_t nodes) const {
        std::vector<std::uint8_t> flags(nodes, 0);
        std::fill_n(flags.begin(), loops_.points.size(), std::uint8_t{1});
        return flags;
    }

    [[nodiscard]] UntangleOptions smoothing() const {
        UntangleOptions options;
        options.always = true;
        return options;
    }

    double flat_quality(const detail::PlaneQuads& plane, CapMesh& mesh) const {
        std::vector<Vec2> nodes = plane.nodes;
        double quality = detail::smallest_corner(nodes, plane.quads);
        if (quality < good) {
            quality = untangle_quads(nodes, plane.quads, fixed(nodes.size()), smoothing()).min_det_after;
        }
        place(nodes, mesh);
        return quality;
    }

    double curved_quality(const detail::PlaneQuads& plane, CapMesh& mesh) const {
        place(plane.nodes, mesh);
        const FaceSurface<GmshBrep> surface{&model_, face_};
        const SmoothReport report =
            untangle_surface_quads(surface, mesh.uv, mesh.quads, fixed(mesh.uv.size()), smoothing());
        put_nodes(mesh);
        return report.min_det_after;
    }

    void place(const std::vector<Vec2>& nodes, CapMesh& mesh) const {
        const Matrix2 to_uv = to_plane_.inverse();
        mesh.uv = boundary_.uv;
        for (std::size_t i = mesh.uv.size(); i < nodes.size(); ++i) {
            mesh.uv.emplace_back(to_uv * nodes[i] + origin_);
        }
        put_nodes(mesh);
    }

    void put_nodes(CapMesh& mesh) const {
        const std::size_t m = boundary_.points.size();
        mesh.nodes.resize(mesh.uv.size());
        std::copy(boundary_.points.begin(), boundary_.points.end(), mesh.nodes.begin());
        if (const auto& plane = boundary_.plane) {
            for (std::size_t i = m; i < mesh.nodes.size(); ++i) {
                mesh.nodes[i] = lift_to_face(model_, face_, plane->point(mesh.uv[i]), plane->normal());
            }
            return;
        }
        model_.face_points(face_, std::span(mesh.uv).subspan(m), std::span(mesh.nodes).subspan(m));
    }

    const GmshBrep& model_;
    FaceId face_;
    const CapBoundary& boundary_;
    CapOptions options_;
    Matrix2 to_plane_;
    Vec2 origin_;
    double size_ = 0;
    detail::PlaneLoops loops_;
    CapMesh best_;
    double best_quality_ = -2;
    int failures_ = 0;
};

}  // namespace

CapMesh mesh_cap(const GmshBrep& model, FaceId face, const CapBoundary& boundary, const CapOptions& options) {
    check_boundary(model, face, boundary, options);
    return CapMaker(model, face, boundary, options).make();
}

}  // namespace pavior

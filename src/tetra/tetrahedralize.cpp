#include <pavior/tetra/tetrahedralize.hpp>

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/near_nodes.hpp>

#include "../common/byte_arrays.hpp"
#include "../common/child_process.hpp"
#include "assemble.hpp"
#include "cgal_engine.hpp"
#include "check_facets.hpp"
#include "facet_edges.hpp"
#include "shells.hpp"
#include "tetgen_engine.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace pavior {

namespace {

using detail::Assembled;
using detail::Problem;

void check_options(const TetOptions& options) {
    const auto bad = [](const std::string& text) { throw InputError(ErrorCode::bad_option, text); };
    if (!(options.quality == 0.0 || (options.quality >= 1.0 && std::isfinite(options.quality)))) {
        bad("quality must be 0 (none) or at least 1");
    }
    if (!(options.max_volume >= 0.0 && std::isfinite(options.max_volume))) {
        bad("max_volume must be 0 (none) or positive");
    }
    if (options.engine == TetEngine::cgal && options.keep_surface) {
        bad("CGAL cannot keep the surface triangles: unset keep_surface, or use TetGen");
    }
    if (!(options.time_limit >= 0.0)) {
        bad("time_limit must be 0 (none) or positive");
    }
}

/// Refuses a limit that asks for more tetrahedra than ids can name.
void check_amount(const Problem& problem, const TetOptions& options) {
    double volume = 0.0;
    for (const TriCorners& c : problem.surface->mesh.triangles) {
        const auto& x = problem.plc.nodes;
        volume += (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(x[c[0]] - x[0]) / 6.0;
    }
    if (options.max_volume > 0.0 && volume > 4e8 * std::ldexp(options.max_volume, -3 * problem.plc.frame.exponent)) {
        throw InputError(ErrorCode::bad_option, "max_volume asks for more than 400 million tetrahedra");
    }
}

/// Tags that fit, edges and nodes that exist.
void check_tags(const TaggedSurface& surface, std::span<const TriCorners> facets) {
    const auto bad = [](ErrorCode code, const std::string& text, std::size_t id) {
        throw InputError(code, text, {static_cast<std::int64_t>(id)});
    };
    if (!surface.face_tags.empty() && surface.face_tags.size() != surface.mesh.triangles.size()) {
        throw InputError(ErrorCode::size_mismatch, "face_tags has not one entry a triangle");
    }
    const std::vector<detail::FacetEdge> known = detail::facet_edges(facets);
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
        const auto [low, high] = std::minmax(surface.edges[e].nodes[0], surface.edges[e].nodes[1]);
        const auto at = std::lower_bound(known.begin(), known.end(), detail::FacetEdge{low, high, 0, 0, false});
        if (at == known.end() || at->low != low || at->high != high) {
            bad(ErrorCode::bad_index, "tagged edge " + std::to_string(e) + " is no edge of a triangle", e);
        }
    }
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        if (surface.vertices[v].node >= surface.mesh.nodes.size()) {
            bad(ErrorCode::bad_index, "tagged vertex " + std::to_string(v) + " is no node of the surface", v);
        }
    }
}

/// Walls must lie in the solids: judged at their centres.
void check_inside(const Problem& problem) {
    const std::vector<Vec3>& x = problem.plc.nodes;
    const std::vector<TriCorners>& boundary = problem.surface->mesh.triangles;
    const detail::TriangleTree tree(x, boundary);
    for (std::size_t i = boundary.size(); i < problem.plc.facets.size(); ++i) {
        const TriCorners& c = problem.plc.facets[i];
        if (tree.crossings((x[c[0]] + x[c[1]] + x[c[2]]) / 3.0, [](std::size_t) { return true; }) % 2 == 0) {
            throw InputError(ErrorCode::inconsistent_boundary,
                             "inner facet " + std::to_string(i - boundary.size()) + " lies outside of the surface",
                             {static_cast<std::int64_t>(i - boundary.size())});
        }
    }
}

Problem checked_problem(const TaggedSurface& surface, std::span<const TaggedTriangle> inner) {
    std::vector<TriCorners> facets = surface.mesh.triangles;
    for (const TaggedTriangle& triangle : inner) {
        facets.push_back(triangle.nodes);
    }
    detail::check_facets(surface.mesh.nodes, facets, surface.mesh.triangles.size()).throw_if_bad();
    check_tags(surface, facets);
    Problem problem = detail::make_problem(surface, inner);
    check_inside(problem);
    return problem;
}

/// A positive number as TetGen reads it: digits, a point and an exponent.
std::string number(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.15g", value);
    return text.data();
}

/// The switches for refinement, common to all attempts.
std::string refinement(const TetOptions& options, const detail::Frame& frame) {
    std::string text;
    if (options.quality > 0.0) {
        text += "q" + number(options.quality);
    }
    if (options.max_volume > 0.0) {
        text += "a" + number(std::ldexp(options.max_volume, -3 * frame.exponent));
    }
    return text;
}

/// What an error says, without the name of its code.
std::string reason(const Error& error) { return std::string(error.what()).substr(to_string(error.code()).size() + 2); }

/// What an engine makes of a complex, as bytes; errors without the name of their code.
std::string raw_bytes(const std::function<detail::RawTets()>& task) {
    try {
        const detail::RawTets raw = task();
        detail::ByteWriter writer;
        writer.add(raw.nodes);
        writer.add(raw.tets);
        writer.add(raw.facets);
        writer.add(raw.facet_numbers);
        writer.add(raw.edges);
        writer.add(raw.edge_numbers);
        return writer.take();
    } catch (const Error& error) {
        throw std::runtime_error(reason(error));
    }
}

detail::RawTets raw_tets(const std::string& bytes) {
    detail::RawTets raw;
    detail::ByteReader reader(bytes);
    reader.get(raw.nodes);
    reader.get(raw.tets);
    reader.get(raw.facets);
    reader.get(raw.facet_numbers);
    reader.get(raw.edges);
    reader.get(raw.edge_numbers);
    return raw;
}

/// Names the flattest triangle of a surface if it is a sliver on which no tetrahedron with a height can stand.
struct Sliver {
    std::size_t triangle = 0;
    double height = 0;
    double length = 0;  ///< of its longest edge

    [[nodiscard]] bool bad() const { return !(height > 1e-9 * length); }
};

std::optional<Sliver> sliver_of(const TriMesh& surface) {
    std::optional<Sliver> worst;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const TriCorners& c = surface.triangles[t];
        const std::array<Vec3, 3> x{surface.nodes[c[0]], surface.nodes[c[1]], surface.nodes[c[2]]};
        Sliver own{t, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            own.length = std::max(own.length, (x[(k + 1) % 3] - x[k]).norm());
        }
        own.height = (x[1] - x[0]).cross(x[2] - x[0]).norm() / own.length;
        if (!worst || own.height * worst->length < worst->height * own.length) {
            worst = own;
        }
    }
    return worst && worst->bad() ? worst : std::nullopt;
}

/// Runs an engine one way after the other until a mesh has no flat tetrahedron; keeps the best.
class Attempts {
public:
    Attempts(std::string engine, const TetOptions& options)
        : engine_(std::move(engine)), limits_{.seconds = options.time_limit, .stop = options.stop} {}

    [[nodiscard]] bool good() const { return best_ && best_->flattest >= good_enough; }

    /// Does nothing if there is a good mesh already.
    void run(const Problem& problem, const std::string& way, const std::function<detail::RawTets()>& task) {
        if (good()) {
            return;
        }
        using End = detail::ChildAnswer::End;
        const detail::ChildAnswer answer = detail::run_in_child([&] { return raw_bytes(task); }, limits_);
        if (answer.end == End::stopped) {
            throw Stopped();
        }
        if (answer.end == End::timed_out) {
            throw InputError(ErrorCode::tetrahedra_failed,
                             engine_ + " (" + way + ") was stopped: no result within the time limit");
        }
        if (answer.end != End::answered) {
            add_reason(way + ": " + answer.reason);
            return;
        }
        try {
            Assembled made = detail::assemble(problem, raw_tets(answer.bytes));
            if (!best_ || made.flattest > best_->flattest) {
                best_ = std::move(made);
            }
        } catch (const Error& error) {
            add_reason(way + ": " + reason(error));
        }
    }

    Assembled result(const TriMesh& surface) {
        if (best_ && best_->flattest < too_flat) {
            add_reason("otherwise tetrahedra without height");
        }
        if (!best_ || best_->flattest < too_flat) {
            if (const std::optional<Sliver> sliver = sliver_of(surface)) {
                throw InputError(ErrorCode::tetrahedra_failed,
                                 "triangle " + std::to_string(sliver->triangle) + " is a sliver, " +
                                     number(sliver->height) + " high at an edge of length " + number(sliver->length) +
                                     ": no tetrahedra with a height stand on it",
                                 {static_cast<std::int64_t>(sliver->triangle)});
            }
            throw InputError(ErrorCode::tetrahedra_failed, engine_ + " finds no tetrahedra (" + reasons_ + ")");
        }
        return std::move(*best_);
    }

private:
    void add_reason(const std::string& text) { reasons_ += (reasons_.empty() ? "" : "; ") + text; }

    /// Altitude by longest edge. Flatter ones come from planar faces whose nodes do not quite lie in one plane.
    static constexpr double good_enough = 1e-6;
    static constexpr double too_flat = 1e-12;

    std::string engine_;
    detail::ChildLimits limits_;
    std::optional<Assembled> best_;
    std::string reasons_;
};

/// What one run spoils, another tolerance or order of insertion seldom spoils too.
void run_tetgen(Attempts& attempts, const Problem& problem, const std::string& keep, const std::string& refine) {
    for (const char* extra : {"", "T1e-12", "O4/7", "b1", "MT1e-14"}) {
        const std::string switches = "p" + keep + "Q" + extra + refine;
        attempts.run(problem, "-" + switches, [&] { return detail::run_tetgen(problem.plc, switches); });
    }
}

/// Edge of a regular tetrahedron.
double edge_of_volume(double volume) { return std::cbrt(6.0 * std::sqrt(2.0) * volume); }

Assembled with_tetgen(const Problem& problem, const TetOptions& options) {
    try {
        detail::prepare_tetgen();
    } catch (const Error& error) {
        throw InputError(ErrorCode::tetrahedra_failed, reason(error));
    }
    Attempts attempts("TetGen", options);
    const std::string refine = refinement(options, problem.plc.frame);
    if (options.keep_surface) {
        run_tetgen(attempts, problem, "Y", refine);
        return attempts.result(problem.surface->mesh);
    }
    run_tetgen(attempts, detail::merge_coplanar(problem), "", refine);
    if (!attempts.good()) {
        // TetGen's own splitting fails now and then: split here, and let it keep that surface.
        const double volume = std::ldexp(options.max_volume, -3 * problem.plc.frame.exponent);
        const double edge = volume > 0.0 ? edge_of_volume(volume) : 1e3;
        run_tetgen(attempts, detail::split_edges(problem, edge), "Y", refine);
    }
    return attempts.result(problem.surface->mesh);
}

Assembled with_cgal(Problem problem, const TetOptions& options) {
    if (problem.plc.facets.size() != problem.surface->mesh.triangles.size()) {
        throw InputError(ErrorCode::bad_option, "CGAL takes no inner facets; use TetGen");
    }
    problem.keep_surface = problem.keep_nodes = false;
    problem.tolerance = 0.02;
    const double volume = std::ldexp(options.max_volume, -3 * problem.plc.frame.exponent);
    const double edge =
        volume > 0.0 ? edge_of_volume(volume) : 0.1 * bounds(std::span<const Vec3>(problem.plc.nodes)).diagonal();
    const double quality = options.quality > 0.0 ? options.quality : 2.0;
    Attempts attempts("CGAL", options);
    // Protected edges close to each other can get in the way of the refinement: fewer of them, or shorter edges.
    for (const double degrees : {10.0, 45.0}) {
        for (const double part : {1.0, 0.86, 0.5, 0.25}) {
            attempts.run(problem, "edges sharper than " + number(degrees) + " degrees, length " + number(part), [&] {
                return detail::run_cgal(problem, {part * edge, quality, degrees});
            });
        }
    }
    return attempts.result(problem.surface->mesh);
}

}  // namespace

TaggedTetMesh tetrahedralize(const TaggedSurface& surface, std::span<const TaggedTriangle> inner_facets,
                             const TetOptions& options) {
    check_options(options);
    const Problem problem = checked_problem(surface, inner_facets);
    check_amount(problem, options);
    return (options.engine == TetEngine::cgal ? with_cgal(problem, options) : with_tetgen(problem, options)).mesh;
}

TaggedTetMesh tetrahedralize(const TaggedSurface& surface, const TetOptions& options) {
    return tetrahedralize(surface, {}, options);
}

}  // namespace pavior

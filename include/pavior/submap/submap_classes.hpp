#pragma once
/// \file
/// Classes of all angles of solids that are to be submapped, by one integer program over all of them.

#include <pavior/brep/face_corners.hpp>
#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/lattice/submap_topology.hpp>
#include <pavior/submap/vertex_classes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

struct SubmapOptions {
    CornerOptions corners;  ///< how far angles of faces and between faces may be from their classes
    /// Edges at which solids turn by a right angle though their faces go on in each other, ascending: lines along round
    /// faces. One stack of hexahedra inside where the surface bulges (a shaft becomes a square bar), three where it is
    /// hollow (a drilled hole becomes a square one). Corners of faces at their ends may be a right angle off.
    std::vector<EdgeId> turns = {};
};

/// Classes of the angles of one solid.
struct SolidClasses {
    std::vector<CornerClass> corner;     ///< per half-edge of the boundary, at its start
    std::vector<std::uint8_t> dihedral;  ///< per half-edge: quarter turns inside the solid
    double deviation = 0.0;              ///< largest difference of an angle from its class, degrees
};

namespace detail {

/// Angle inside the solid along half-edge \p h: the median of three places. Its sense does not matter.
template <brep B>
[[nodiscard]] double mean_dihedral(const B& b, const SolidBoundary& boundary, std::size_t h) {
    const SolidBoundary::HalfEdge& edge = boundary.half_edges[h];
    const OrientedFace f = boundary.faces[edge.face].face, g = boundary.faces[boundary.twin_face(h)].face;
    std::array<double, 3> angle{};
    for (std::size_t i = 0; i < 3; ++i) {
        angle[i] = dihedral_angle(b, f, g, edge.use, std::array{0.1, 0.5, 0.9}[i]);
    }
    std::sort(angle.begin(), angle.end());
    return angle[1];
}

[[nodiscard]] inline std::string degrees(double angle) {
    std::string text = std::to_string(std::round(10.0 * angle) / 10.0);
    text.erase(text.find_last_not_of('0') + 1);
    return (text.back() == '.' ? text.substr(0, text.size() - 1) : text) + " degrees";
}

/// Whether the surface of the first face of half-edge \p h bends away from the outside across the edge, as a shaft
/// does.
template <brep B>
[[nodiscard]] bool bulges(const B& b, const SolidBoundary& boundary, std::size_t h) {
    const SolidBoundary::HalfEdge& edge = boundary.half_edges[h];
    const OrientedFace f = boundary.faces[edge.face].face;
    const auto range = b.edge_range(edge.use.edge);
    const Vec2 uv = b.edge_on_face(edge.use.edge, 0.5 * (range[0] + range[1]), f.face, edge.use.forward == f.outward);
    const auto [du, dv] = b.face_derivatives(f.face, uv);
    const Vec3 n = outward_normal(b, f, uv);
    const Vec3 along = b.edge_derivative(edge.use.edge, 0.5 * (range[0] + range[1])).normalized();
    const Vec3 across = 1e-3 * b.edge_length(edge.use.edge) * n.cross(along);
    Eigen::Matrix<double, 3, 2> frame;
    frame << du, dv;
    const Vec2 step = (frame.transpose() * frame).inverse() * frame.transpose() * across;
    return (outward_normal(b, f, uv + step) - outward_normal(b, f, uv - step)).dot(across) > 0;
}

/// The integer program: one binary variable for each way to classify an umbrella.
template <brep B>
class SubmapProgram {
public:
    SubmapProgram(const B& b, std::span<const SolidBoundary> solids, const SubmapOptions& options)
        : b_(b), solids_(solids), options_(options) {
        for (std::size_t s = 0; s < solids.size(); ++s) {
            add_solid(s);
        }
        for (std::size_t s = 0; s < solids.size(); ++s) {
            add_edges(s);
            add_loops(s);
        }
        add_shared_corners();
    }

    template <integer_solver Solver>
    [[nodiscard]] std::vector<SolidClasses> solve(Solver& solver) const {
        const IntegerSolution solution = solver(program_);
        if (!solution.found()) {
            throw unsolved(solution.status, solver);
        }
        std::vector<SolidClasses> result;
        for (const Angles& angles : angles_) {
            SolidClasses classes{std::vector<CornerClass>(angles.corner.size()),
                                 std::vector<std::uint8_t>(angles.corner.size()), 0.0};
            result.push_back(std::move(classes));
        }
        for (const Choice& choice : choices_) {
            if (solution.values[choice.variable] < 0.5) {
                continue;
            }
            SolidClasses& classes = result[choice.solid];
            const Angles& angles = angles_[choice.solid];
            for (std::size_t i = 0; i < choice.classes.corner.size(); ++i) {
                const std::size_t h = umbrellas_[choice.umbrella].half_edges[i];
                classes.corner[h] = choice.classes.corner[i];
                classes.dihedral[h] = choice.classes.dihedral[i];
                classes.deviation =
                    std::max({classes.deviation, std::abs(corner_deviation(angles.corner[h], classes.corner[h])),
                              std::abs(angles.dihedral[h] - 90.0 * classes.dihedral[h])});
            }
        }
        return result;
    }

private:
    struct Angles {
        std::vector<double> corner, dihedral;  ///< per half-edge
    };
    struct Choice {
        std::size_t variable = 0, solid = 0, umbrella = 0;
        VertexClasses classes;
    };
    using Row = std::map<std::size_t, double>;

    void add_solid(std::size_t s) {
        const SolidBoundary& boundary = solids_[s];
        Angles angles;
        for (std::size_t h = 0; h < boundary.half_edges.size(); ++h) {
            angles.corner.push_back(boundary.half_edges[h].angle);
            const std::size_t twin = boundary.half_edges[h].twin;
            const auto angle = [&] {
                return turns(boundary, h) ? bulges(b_, boundary, h) ? 90 : 270 : mean_dihedral(b_, boundary, h);
            };
            angles.dihedral.push_back(twin < h ? angles.dihedral[twin] : angle());
        }
        for (const SolidBoundary::Face& face : boundary.faces) {
            if (face.loops.empty()) {
                throw refusal("face " + std::to_string(face.tag) + " has no corner", {face.tag});
            }
        }
        angles_.push_back(std::move(angles));
        corners_.emplace_back(boundary.half_edges.size());
        dihedrals_.emplace_back(boundary.half_edges.size());
        for (Umbrella& umbrella : umbrellas(boundary)) {
            add_umbrella(s, std::move(umbrella));
        }
    }

    [[nodiscard]] bool turns(const SolidBoundary& boundary, std::size_t h) const {
        return std::binary_search(options_.turns.begin(), options_.turns.end(), boundary.half_edges[h].use.edge);
    }

    /// For corners at some half-edges: any class within a right angle where one of them turns.
    [[nodiscard]] CornerOptions corner_options(const SolidBoundary& boundary, std::span<const std::size_t> some) const {
        CornerOptions result = options_.corners;
        if (std::any_of(some.begin(), some.end(), [&](std::size_t h) { return turns(boundary, h); })) {
            result.max_deviation = 90;
        }
        return result;
    }

    /// Angles between faces are as near to their classes as anywhere, those of turns are these.
    [[nodiscard]] bool keeps_dihedrals(std::size_t s, const Umbrella& umbrella, const VertexClasses& classes) const {
        for (std::size_t i = 0; i < umbrella.half_edges.size(); ++i) {
            const std::size_t h = umbrella.half_edges[i];
            const double off = std::abs(angles_[s].dihedral[h] - 90.0 * classes.dihedral[i]);
            if (off > (turns(solids_[s], h) ? 1.0 : options_.corners.max_deviation + 1e-9)) {
                return false;
            }
        }
        return true;
    }

    void add_umbrella(std::size_t s, Umbrella umbrella) {
        std::vector<double> corner, dihedral;
        for (const std::size_t h : umbrella.half_edges) {
            corner.push_back(angles_[s].corner[h]);
            dihedral.push_back(angles_[s].dihedral[h]);
        }
        std::vector<VertexClasses> all =
            vertex_classes(corner, dihedral, corner_options(solids_[s], umbrella.half_edges));
        std::erase_if(all, [&](const VertexClasses& classes) { return !keeps_dihedrals(s, umbrella, classes); });
        if (all.empty()) {
            throw no_classes(s, umbrella, corner, dihedral);
        }
        IntegerProgram::Row one{1.0, 1.0, {}, {}};
        for (VertexClasses& classes : all) {
            const std::size_t x = program_.add({0.0, 1.0, classes.cost, true, {}});
            one.terms.emplace_back(x, 1.0);
            for (std::size_t i = 0; i < umbrella.half_edges.size(); ++i) {
                corners_[s][umbrella.half_edges[i]][x] += static_cast<double>(classes.corner[i]);
                dihedrals_[s][umbrella.half_edges[i]][x] += static_cast<double>(classes.dihedral[i]);
            }
            choices_.push_back({x, s, umbrellas_.size(), std::move(classes)});
        }
        program_.rows.push_back(std::move(one));
        row_faces_.emplace_back();
        umbrellas_.push_back(std::move(umbrella));
    }

    void add_row(const Row& row, double value, std::set<int> faces) {
        IntegerProgram::Row result{value, value, {}, {}};
        for (const auto& [variable, coefficient] : row) {
            if (coefficient != 0.0) {
                result.terms.emplace_back(variable, coefficient);
            }
        }
        if (!result.terms.empty() || value != 0.0) {
            program_.rows.push_back(std::move(result));
            row_faces_.push_back(std::move(faces));
        }
    }

    [[nodiscard]] static Row difference(Row a, const Row& c) {
        for (const auto& [variable, coefficient] : c) {
            a[variable] -= coefficient;
        }
        return a;
    }

    /// The angle between two faces has the same class at both ends of their edge.
    void add_edges(std::size_t s) {
        const auto& half_edges = solids_[s].half_edges;
        for (std::size_t h = 0; h < half_edges.size(); ++h) {
            const std::size_t twin = half_edges[h].twin;
            if (h < twin) {
                add_row(difference(dihedrals_[s][h], dihedrals_[s][twin]), 0.0,
                        {solids_[s].faces[half_edges[h].face].tag, solids_[s].faces[half_edges[twin].face].tag});
            }
        }
    }

    /// The quarter turns of an outer loop sum up to 4, those of a hole to -4.
    void add_loops(std::size_t s) {
        for (const SolidBoundary::Face& face : solids_[s].faces) {
            for (std::size_t l = 0; l < face.loops.size(); ++l) {
                const std::vector<std::size_t> loop = solids_[s].loop_from(face.loops[l]);
                std::vector<double> angles;
                Row row;
                for (const std::size_t h : loop) {
                    angles.push_back(angles_[s].corner[h]);
                    for (const auto& [variable, coefficient] : corners_[s][h]) {
                        row[variable] += coefficient;
                    }
                }
                const int total = l == 0 ? 4 : -4;
                if (!classify_loop(
                        angles, total,
                        options_.turns.empty() ? options_.corners : CornerOptions{90, options_.corners.reversals})) {
                    throw wrong_turning(face, l, angles);
                }
                add_row(row, 2.0 * static_cast<double>(loop.size()) - total, {face.tag});
            }
        }
    }

    /// A face of two solids has the same corners in both.
    void add_shared_corners() {
        std::map<std::tuple<FaceId, std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> seen;
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            for (const SolidBoundary::Face& face : solids_[s].faces) {
                for (std::size_t l = 0; l < face.loops.size(); ++l) {
                    const std::vector<std::size_t> loop = solids_[s].loop_from(face.loops[l]);
                    for (std::size_t i = 0; i < loop.size(); ++i) {
                        const std::size_t own = face.face.outward ? i : (loop.size() - i) % loop.size();
                        const auto [at, fresh] = seen.try_emplace({face.face.face, l, own}, s, loop[i]);
                        if (!fresh) {
                            add_row(difference(corners_[s][loop[i]], corners_[at->second.first][at->second.second]),
                                    0.0, {face.tag});
                        }
                    }
                }
            }
        }
    }

    [[nodiscard]] static UnmeshableError refusal(const std::string& text, const std::set<int>& faces) {
        return {ErrorCode::not_submappable, text, Error::Ids(faces.begin(), faces.end())};
    }

    [[nodiscard]] UnmeshableError no_classes(std::size_t s, const Umbrella& umbrella, std::span<const double> corner,
                                             std::span<const double> dihedral) const {
        const SolidBoundary& boundary = solids_[s];
        const std::string vertex = "vertex " + std::to_string(b_.tag(0, umbrella.vertex.index()));
        std::set<int> faces;
        for (std::size_t i = 0; i < corner.size(); ++i) {
            const std::size_t h = umbrella.half_edges[i];
            const int tag = boundary.faces[boundary.half_edges[h].face].tag;
            if (corner_classes(corner[i], options_.corners).empty()) {
                return refusal("the corner of face " + std::to_string(tag) + " at " + vertex + ", " +
                                   degrees(corner[i]) + ", is not near a multiple of 90 degrees",
                               {tag});
            }
            if (corner_classes(dihedral[i], options_.corners).empty()) {
                const int other = boundary.faces[boundary.twin_face(h)].tag;
                return refusal("the angle between faces " + std::to_string(tag) + " and " + std::to_string(other) +
                                   ", " + degrees(dihedral[i]) + ", is not near a multiple of 90 degrees",
                               {tag, other});
            }
            faces.insert(tag);
        }
        return refusal(
            list(faces, "face", "faces") + ": their angles at " + vertex + " are not those of a union of boxes", faces);
    }

    [[nodiscard]] UnmeshableError wrong_turning(const SolidBoundary::Face& face, std::size_t l,
                                                std::span<const double> angles) const {
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(angles.size(), 12); ++i) {
            text += (i == 0 ? "" : ", ") + degrees(angles[i]).substr(0, degrees(angles[i]).find(' '));
        }
        return refusal("the corners of the " + std::string(l == 0 ? "outer" : "inner") + " loop of face " +
                           std::to_string(face.tag) + " (" + text + (angles.size() > 12 ? ", ..." : "") +
                           " degrees) are not those of a union of rectangles",
                       {face.tag});
    }

    /// Names the faces of a smallest set of loops and edges whose conditions contradict each other.
    template <integer_solver Solver>
    [[nodiscard]] UnmeshableError unsolved(ProgramStatus status, Solver& solver) const {
        if (status != ProgramStatus::infeasible) {
            return refusal("no classes of the corners were found in the time allowed", {});
        }
        IntegerProgram program = program_;
        std::vector<std::set<int>> faces = row_faces_;
        for (std::size_t chunk = std::max<std::size_t>(program.rows.size() / 2, 1); chunk > 0; chunk /= 2) {
            for (std::size_t at = umbrellas_.size(); at < program.rows.size();) {
                const auto first = static_cast<std::ptrdiff_t>(at);
                const auto last = static_cast<std::ptrdiff_t>(std::min(at + chunk, program.rows.size()));
                IntegerProgram less = program;
                less.rows.erase(less.rows.begin() + first, less.rows.begin() + last);
                const IntegerSolution without = solver(less);
                if (without.status == ProgramStatus::infeasible) {
                    program = std::move(less);
                    faces.erase(faces.begin() + first, faces.begin() + last);
                } else {
                    at = static_cast<std::size_t>(last);
                }
            }
        }
        std::set<int> named;
        for (std::size_t i = umbrellas_.size(); i < faces.size(); ++i) {
            named.insert(faces[i].begin(), faces[i].end());
        }
        return refusal(
            "no choice of corners makes " + list(named, "face", "faces") + " unions of rectangles that fit together",
            named);
    }

    const B& b_;
    std::span<const SolidBoundary> solids_;
    const SubmapOptions& options_;
    std::vector<Angles> angles_;
    std::vector<Umbrella> umbrellas_;
    std::vector<Choice> choices_;
    std::vector<std::vector<Row>> corners_, dihedrals_;  ///< per solid and half-edge: the class as a linear expression
    IntegerProgram program_;
    std::vector<std::set<int>> row_faces_;  ///< per row
};

}  // namespace detail

/// Chooses the classes of all corners of faces and of all angles between faces of \p solids together: round every
/// vertex they fit a union of cubes, along every edge the angle between the faces has one class, the quarter turns of
/// every outer loop sum up to 4 and of every hole to -4, and a face of two solids has the same corners in both. Among
/// these the sum of the squared deviations is least. \p solver turns an IntegerProgram into an IntegerSolution.
/// \return one entry a solid. \throws UnmeshableError not_submappable; the message gives the reason, the ids are the
/// tags of the faces concerned.
template <brep B, integer_solver Solver>
[[nodiscard]] std::vector<SolidClasses> classify_solids(const B& b, std::span<const SolidBoundary> solids,
                                                        const SubmapOptions& options, Solver&& solver) {
    return detail::SubmapProgram<B>(b, solids, options).solve(solver);
}

}  // namespace pavior

#pragma once
/// \file
/// The search for cuts after which methods mesh all pieces of some solids.

#include <pavior/core/stop.hpp>
#include <pavior/decompose/cut_candidates.hpp>
#include <pavior/decompose/cut_search.hpp>
#include <pavior/decompose/recognise_piece.hpp>
#include <pavior/decompose/solid_cut.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

namespace pavior {

/// What came of meshing pieces.
struct PiecesVerdict {
    double quality = -1;  ///< least scaled Jacobian of a valid mesh; below 0: there is none
    SolidId guilty;       ///< the piece with the worst hexahedron, or that was refused; not valid if not known
};

namespace detail {

/// The model after some cuts.
template <solid_pieces P>
struct CutState {
    std::vector<SolidCut> cuts;
    P pieces;
    std::vector<PieceMethods> methods = {};  ///< by position in `solids`
    std::vector<SolidId> solids = {};        ///< pieces of the solids asked for
    double cost = 0;
    std::size_t order = 0;    ///< in which it was found
    SolidId next = {};        ///< the piece to cut
    std::size_t clashes = 0;  ///< pieces that touch and are swept many-to-many in different directions

    [[nodiscard]] bool complete() const {
        return std::all_of(methods.begin(), methods.end(), [](const PieceMethods& m) { return m.any(); });
    }
};

template <solid_pieces P, class Cutter, class Solver, class Verdict, class OutOfTime, class PieceQuality>
class CutSearcher {
public:
    using State = CutState<P>;

    CutSearcher(std::span<const SolidId> solids, Cutter& cutter, Solver& solver, Verdict& verdict,
                OutOfTime& out_of_time, const CutSearchOptions& options, PieceQuality& piece_quality)
        : wanted_(solids.begin(), solids.end()),
          cutter_(cutter),
          solver_(solver),
          verdict_(verdict),
          out_of_time_(out_of_time),
          options_(options),
          piece_quality_(piece_quality) {}

    [[nodiscard]] CutSearch run() {
        std::optional<State> root = state({});
        if (!root) {
            return {};
        }
        root->next = worst_piece(*root);
        open_.push_back(std::move(*root));
        while (!open_.empty() && !done()) {
            const auto best = std::min_element(open_.begin(), open_.end(), [](const State& x, const State& y) {
                return std::pair(x.cost, x.order) < std::pair(y.cost, y.order);
            });
            State at = std::move(*best);
            open_.erase(best);
            if (at.clashes > 0 && !at.cuts.empty()) {
                mesh_complete(at);
            }
            expand(at);
        }
        return std::move(result_);
    }

private:
    [[nodiscard]] bool done() const {
        return result_.quality >= options_.sufficient || result_.tried >= options_.max_cuts ||
               result_.meshed >= options_.max_meshes || hopeless() || out_of_time_();
    }

    [[nodiscard]] bool hopeless() const { return result_.tried - curved_ >= options_.max_idle && result_.meshed == 0; }

    /// Meshes each piece by itself that was not yet; which may change what is known of it.
    void mesh_pieces(State& at) {
        for (std::size_t i = 0; i < at.solids.size(); ++i) {
            PieceMethods& known = known_.at(signature(*at.pieces.model, at.solids[i]));
            if (known.quality > 1) {
                known.quality = piece_quality_(at.pieces, at.solids[i], known);
            }
            at.methods[i] = known;
        }
        add_costs(at);
        at.next = worst_piece(at);
    }

    /// Meshes pieces all of which a method takes, first each alone, then together.
    void mesh_complete(State& at) {
        if (at.complete()) {
            mesh_pieces(at);
        }
        if (at.complete() && !done()) {
            mesh(at);
        }
    }

    /// Keeps a new state, meshed if that makes sense.
    void take(State at) {
        check_stop(options_.stop);
        at.next = worst_piece(at);
        if (at.clashes == 0) {
            mesh_complete(at);
        }
        open_.push_back(std::move(at));
    }

    void mesh(State& at) {
        check_stop(options_.stop);
        const PiecesVerdict verdict =
            verdict_(at.pieces, std::span<const SolidId>(at.solids), std::span<const PieceMethods>(at.methods));
        ++result_.meshed;
        if (verdict.quality > result_.quality) {
            result_.quality = verdict.quality;
            result_.cuts = at.cuts;
        }
        at.cost += verdict.quality < 0 ? options_.costs.misfit : 0.0;
        if (verdict.guilty.valid()) {
            at.next = verdict.guilty;
        }
    }

    void add_costs(State& at) const {
        at.cost = 0;
        at.clashes = 0;
        std::map<FaceId, std::size_t> first;  // face: the first piece that has it
        for (std::size_t i = 0; i < at.solids.size(); ++i) {
            at.cost += cost(at.methods[i], options_.costs);
            for (const OrientedFace& f : (*at.pieces.model).solid_faces(at.solids[i])) {
                const auto [other, is_first] = first.emplace(f.face, i);
                at.clashes += !is_first && clash(at.methods[other->second], at.methods[i]) ? 1 : 0;
            }
        }
        at.cost += options_.costs.clash * static_cast<double>(at.clashes);
    }

    [[nodiscard]] static bool clash(const PieceMethods& a, const PieceMethods& b) {
        return a.only_multi_sweep() && b.only_multi_sweep() &&
               std::none_of(a.directions.begin(), a.directions.end(), [&](const Vec3& d) {
                   return std::any_of(b.directions.begin(), b.directions.end(),
                                      [&](const Vec3& e) { return d.cross(e).norm() < 1e-6; });
               });
    }

    /// Tries all cuts of one piece.
    void expand(const State& at) {
        if (at.solids.size() >= options_.max_pieces * wanted_.size()) {
            return;
        }
        std::vector<CutCandidate> candidates = cut_candidates(*at.pieces.model, at.next);
        if (std::any_of(at.cuts.begin(), at.cuts.end(), [](const SolidCut& cut) { return !cut.surfaces.empty(); })) {
            // Curves are for whole solids: on pieces they would take tries from what helps there.
            std::erase_if(candidates, [](const CutCandidate& c) { return c.surfaces.empty(); });
        }
        for (const CutCandidate& candidate : candidates) {
            check_stop(options_.stop);
            if (done()) {
                return;
            }
            std::vector<SolidCut> cuts = at.cuts;
            cuts.push_back({at.next, candidate.surfaces, candidate.reason, candidate.curves});
            curved_ += candidate.surfaces.empty() ? 1 : 0;
            std::optional<State> next = state(std::move(cuts));
            if (next && next->cost < at.cost + 0.5 && (!candidate.surfaces.empty() || takes_more(at, *next))) {
                take(std::move(*next));
            }
        }
    }

    /// Whether a method takes a piece more than before: curves help with nothing else.
    [[nodiscard]] static bool takes_more(const State& before, const State& after) {
        const auto taken = [](const State& at) {
            return std::count_if(at.methods.begin(), at.methods.end(), [](const PieceMethods& m) { return m.any(); });
        };
        return taken(after) > taken(before);
    }

    [[nodiscard]] std::optional<State> state(std::vector<SolidCut> cuts) {
        ++result_.tried;
        std::optional<P> pieces = cutter_(std::span<const SolidCut>(cuts));
        if (!pieces) {
            return std::nullopt;
        }
        State result{std::move(cuts), std::move(*pieces)};
        result.order = result_.tried;
        const std::vector<EdgeId> turns = edges_on_curves(*result.pieces.model, std::span<const SolidCut>(result.cuts));
        for (std::size_t s = 0; s < result.pieces.solid.size(); ++s) {
            if (std::find(wanted_.begin(), wanted_.end(), result.pieces.solid[s]) != wanted_.end()) {
                const SolidId solid{static_cast<std::int32_t>(s)};
                result.solids.push_back(solid);
                result.methods.push_back(methods_of(*result.pieces.model, solid, turns));
            }
        }
        add_costs(result);
        return result;
    }

    /// Sums over the boundary of a piece, in units of 1e-7 of its extent or so: what is not cut keeps them.
    template <brep M>
    [[nodiscard]] static std::vector<long long> signature(const M& b, SolidId solid) {
        std::set<EdgeId> edges;
        for (const OrientedFace& f : b.solid_faces(solid)) {
            for (const EdgeLoop& loop : b.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    edges.insert(use.edge);
                }
            }
        }
        double length = 0;
        Vec3 first = Vec3::Zero();
        Vec3 second = Vec3::Zero();
        for (const EdgeId e : edges) {
            const auto range = b.edge_range(e);
            const Vec3 middle = b.edge_point(e, 0.5 * (range[0] + range[1]));
            const Vec3 ends = b.edge_point(e, range[0]) + b.edge_point(e, range[1]);
            length += b.edge_length(e);
            first += middle + ends;
            second += middle.cwiseAbs2() + ends.cwiseAbs2();
        }
        std::vector<long long> key{static_cast<long long>(b.solid_faces(solid).size()),
                                   static_cast<long long>(edges.size())};
        const auto add = [&](double x) { key.push_back(std::llround(1e7 * x / length)); };
        for (int k = 0; k < 3; ++k) {
            add(first[k]);
            add(second[k] / length);
        }
        return key;
    }

    /// recognise_piece(), once for a piece that stays as it is.
    template <brep M>
    [[nodiscard]] PieceMethods methods_of(const M& b, SolidId solid, const std::vector<EdgeId>& turns) {
        const std::vector<long long> key = signature(b, solid);
        const auto known = known_.find(key);
        if (known != known_.end()) {
            return known->second;
        }
        return known_[key] = recognise_piece(b, solid, solver_, turns);
    }

    /// The one that costs most, then the one with the most faces.
    [[nodiscard]] SolidId worst_piece(const State& at) const {
        std::size_t worst = 0;
        const auto rank = [&](std::size_t i) {
            return std::pair(cost(at.methods[i], options_.costs), (*at.pieces.model).solid_faces(at.solids[i]).size());
        };
        for (std::size_t i = 1; i < at.solids.size(); ++i) {
            worst = rank(i) > rank(worst) ? i : worst;
        }
        return at.solids[worst];
    }

    std::vector<SolidId> wanted_;
    Cutter& cutter_;
    Solver& solver_;
    Verdict& verdict_;
    OutOfTime& out_of_time_;
    CutSearchOptions options_;
    PieceQuality& piece_quality_;
    std::vector<State> open_;
    std::map<std::vector<long long>, PieceMethods> known_;  ///< by signature()
    CutSearch result_;
    std::size_t curved_ = 0;  ///< tries of curves alone
};

/// Pieces are as good as recognition takes them for.
struct TrustPiece {
    template <class P>
    double operator()(const P&, SolidId, const PieceMethods&) const {
        return 1;
    }
};

}  // namespace detail

/// Looks for cuts of \p solids after which they can be meshed: best first by cost() of the pieces, which recognition
/// alone tells. Where that finds a method for every piece, piece_quality(pieces, piece, methods), once for each piece,
/// is the least scaled Jacobian of a mesh of it alone, below 0 if there is none; where all pieces have one,
/// verdict(pieces, solids of the pieces' model, methods of each), a PiecesVerdict, meshes them together. The piece
/// that costs most is cut next, or the one that spoils the mesh, by one of cut_candidates(). \p cutter is a
/// solid_cutter of the model that \p solids belong to, \p P what it makes, \p out_of_time() ends the search early.
/// Deterministic if the callables are. A call of the cutter for each try, of recognise_piece() for each new piece.
/// \throws Stopped; what the callables throw
template <solid_pieces P, solid_cutter<P> Cutter, integer_solver Solver, class Verdict, std::predicate OutOfTime,
          class PieceQuality = detail::TrustPiece>
[[nodiscard]] CutSearch best_cuts(std::span<const SolidId> solids, Cutter&& cutter, Solver&& solver, Verdict&& verdict,
                                  OutOfTime&& out_of_time, const CutSearchOptions& options = {},
                                  PieceQuality piece_quality = {}) {
    return detail::CutSearcher<P, Cutter, Solver, Verdict, OutOfTime, PieceQuality>(solids, cutter, solver, verdict,
                                                                                    out_of_time, options, piece_quality)
        .run();
}

}  // namespace pavior

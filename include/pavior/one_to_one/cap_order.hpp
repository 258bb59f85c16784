#pragma once
/// \file
/// The order in which the sweeps of an assembly are meshed, so that every shared cap is meshed once.

#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// The same sweep run from its target to its source.
[[nodiscard]] inline SweepTopology reversed(const SweepTopology& sweep) {
    SweepTopology result = sweep;
    std::swap(result.source, result.target);
    std::swap(result.source_outward, result.target_outward);
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        result.source_loops[i] = reversed(sweep.target_loops[i]);
        result.target_loops[i] = reversed(sweep.source_loops[i]);
        std::vector<LinkingSide>& sides = result.loops[i];
        std::reverse(sides.begin(), sides.end());
        for (LinkingSide& side : sides) {
            side = upside_down(side);
        }
    }
    return result;
}

/// One step of the order: which sweep, and whether it runs against its topology.
struct SweepStep {
    std::size_t sweep = 0;
    bool backwards = false;

    friend bool operator==(const SweepStep&, const SweepStep&) = default;
};

namespace detail {

/// Walks chains of sweeps over shared caps.
class CapWalk {
public:
    explicit CapWalk(std::span<const SweepTopology> sweeps) : sweeps_(sweeps), done_(sweeps.size(), false) {
        for (std::size_t i = 0; i < sweeps.size(); ++i) {
            users_[sweeps[i].source].push_back(i);
            users_[sweeps[i].target].push_back(i);
        }
    }

    /// Takes all that can be reached from \p cap, whose mesh is known.
    void run(FaceId cap) {
        for (std::size_t i = next(cap); i < sweeps_.size(); i = next(cap)) {
            const bool backwards = sweeps_[i].source != cap;
            order_.push_back({i, backwards});
            done_[i] = true;
            cap = backwards ? sweeps_[i].source : sweeps_[i].target;
        }
    }

    /// The cap at the far end of the chain that reaches sweep \p i through its source.
    [[nodiscard]] FaceId far_end(std::size_t i) const {
        std::vector<bool> seen = done_;
        FaceId cap = sweeps_[i].source;
        seen[i] = true;
        for (std::size_t j = next(cap, seen); j < sweeps_.size(); j = next(cap, seen)) {
            seen[j] = true;
            cap = sweeps_[j].source == cap ? sweeps_[j].target : sweeps_[j].source;
        }
        return cap == sweeps_[i].target ? sweeps_[i].source : cap;  // a closed chain comes back from the other side
    }

    [[nodiscard]] bool done(std::size_t i) const { return done_[i]; }
    [[nodiscard]] const std::map<FaceId, std::vector<std::size_t>>& users() const { return users_; }
    [[nodiscard]] std::vector<SweepStep> order() && { return std::move(order_); }

private:
    [[nodiscard]] std::size_t next(FaceId cap) const { return next(cap, done_); }
    [[nodiscard]] std::size_t next(FaceId cap, const std::vector<bool>& taken) const {
        for (const std::size_t i : users_.at(cap)) {
            if (!taken[i]) {
                return i;
            }
        }
        return sweeps_.size();
    }

    std::span<const SweepTopology> sweeps_;
    std::vector<bool> done_;
    std::map<FaceId, std::vector<std::size_t>> users_;
    std::vector<SweepStep> order_;
};

}  // namespace detail

/// An order of all \p sweeps in which each one finds at most its source meshed by an earlier one, wherever that is
/// possible: chains over shared caps are walked from one end, from a cap with `meshed(face)` (one that is a linking
/// side of another solid) if there is one, otherwise from the end before the source of their first sweep. Closed chains
/// start at the source of their first sweep; their last sweep finds both caps meshed. Deterministic, O(n log n) for
/// chains of bounded length.
template <class Meshed>
[[nodiscard]] std::vector<SweepStep> cap_order(std::span<const SweepTopology> sweeps, Meshed&& meshed) {
    detail::CapWalk walk(sweeps);
    for (const auto& [cap, users] : walk.users()) {
        if (meshed(cap)) {
            walk.run(cap);
            walk.run(cap);  // the solid on its other side
        }
    }
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        if (!walk.done(i)) {
            walk.run(walk.far_end(i));
        }
    }
    return std::move(walk).order();
}

}  // namespace pavior

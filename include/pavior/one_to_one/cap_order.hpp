#pragma once
/// \file
/// The order in which the sweeps of an assembly are meshed, so that every shared cap is meshed once.

#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// The same sweep run from its target to its source.
[[nodiscard]] PAVIOR_INLINE SweepTopology reversed(const SweepTopology& sweep);

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
    explicit CapWalk(std::span<const SweepTopology> sweeps);

    /// Takes all that can be reached from \p cap, whose mesh is known.
    void run(FaceId cap);

    /// The cap at the far end of the chain that reaches sweep \p i through its source.
    [[nodiscard]] FaceId far_end(std::size_t i) const;

    [[nodiscard]] bool done(std::size_t i) const { return done_[i]; }
    [[nodiscard]] const std::map<FaceId, std::vector<std::size_t>>& users() const { return users_; }
    [[nodiscard]] std::vector<SweepStep> order() && { return std::move(order_); }

private:
    [[nodiscard]] std::size_t next(FaceId cap) const { return next(cap, done_); }
    [[nodiscard]] std::size_t next(FaceId cap, const std::vector<bool>& taken) const;

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

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/cap_order-inl.hpp>
#endif

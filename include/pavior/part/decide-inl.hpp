#pragma once

#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/part/decide.hpp>

#include <cstddef>
#include <utility>

namespace pavior {

namespace detail {

/// A valid mesh is better than an invalid one, then the least scaled Jacobian counts.
[[nodiscard]] inline bool better_try(const MethodTry& a, const MethodTry& b) {
    return std::pair(a.outcome == TryOutcome::mesh, a.min_jacobian) >
           std::pair(b.outcome == TryOutcome::mesh, b.min_jacobian);
}

/// Takes the last mesh if it is better than the one taken so far; the other is dropped. In the place of a valid one
/// whose least scaled Jacobian is a quarter of \p least it comes only if its own is \p least.
inline void take_better(PartDecision& decision, double least) {
    MethodTry& last = decision.tries.back();
    if (!last.has_mesh()) {
        return;
    }
    if (decision.taken) {
        const MethodTry& taken = decision.tries[*decision.taken];
        const bool stays = decision.valid() && taken.min_jacobian >= 0.25 * least && last.min_jacobian < least;
        if (stays || !better_try(last, taken)) {
            last.data = {};
            return;
        }
        decision.tries[*decision.taken].data = {};
    }
    decision.taken = decision.tries.size() - 1;
}

[[nodiscard]] inline std::vector<PartMethod> methods_for(std::size_t solids, const PartOptions& options) {
    std::vector<PartMethod> methods = options.methods;
    if (methods.empty()) {
        methods = {PartMethod::submap, PartMethod::sweep, PartMethod::multi_sweep, PartMethod::mixed};
        if (options.decompose) {
            methods.push_back(PartMethod::decompose);
        }
        methods.push_back(PartMethod::block);
        if (options.last_resort) {
            methods.push_back(PartMethod::split);
        }
    }
    if (solids == 1 && methods.size() > 1) {
        std::erase(methods, PartMethod::mixed);
    }
    return methods;
}

}  // namespace detail

PAVIOR_INLINE PartDecision decide(std::vector<SolidId> solids, const PartOptions& options, const PartAttempt& attempt) {
    PartDecision result;
    result.solids = std::move(solids);
    const double limit = options.seconds * static_cast<double>(result.solids.size());
    const std::vector<PartMethod> methods = detail::methods_for(result.solids.size(), options);
    const bool last_resort = options.methods.empty() && options.last_resort;
    const double kept = last_resort ? 0.35 * limit : 0;
    const Stopwatch watch;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        check_stop(options.execution.stop);
        MethodTry next;
        next.method = methods[m];
        const bool resort = last_resort && m + 1 == methods.size();
        // A process that was ended late must not cost the last resort all of its time.
        const double left = resort ? std::max(limit - watch.total(), 0.5 * kept) : limit - kept - watch.total();
        if (result.valid() && result.tries[*result.taken].min_jacobian >= options.sufficient) {
            next.reason = "not needed";
        } else if (limit > 0 && left <= 0) {
            next.reason = "no time left";
            result.out_of_time = true;
        } else {
            const bool last = m + (last_resort && !resort ? 2 : 1) == methods.size();
            next = attempt(methods[m], limit > 0 ? left / (last ? 1 : 2) : 0);
            result.out_of_time = result.out_of_time || next.outcome == TryOutcome::timed_out;
        }
        result.tries.push_back(std::move(next));
        detail::take_better(result, resort ? options.sufficient : 0);
    }
    return result;
}

}  // namespace pavior

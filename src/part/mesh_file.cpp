#include <pavior/part/mesh_file.hpp>

#include "../common/child_process.hpp"
#include "gmsh_kernels.hpp"
#include "try_bytes.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/part/mesh_part.hpp>
#include <pavior/part/try_method.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iomanip>
#include <mutex>
#include <sstream>
#include <stop_token>
#include <thread>

#include <unistd.h>

namespace pavior {

namespace {

/// Ends this process after so many seconds unless it is told before that a mesh is made. Nothing to do for 0 seconds.
class MadeInTime {
public:
    explicit MadeInTime(double seconds) {
        if (seconds > 0) {
            guard_ = std::jthread([this, seconds](const std::stop_token& stop) {
                std::unique_lock lock(mutex_);
                const std::chrono::duration<double> limit(std::min(seconds, 1e8));
                made_.wait_for(lock, stop, limit, [] { return false; });
                if (!stop.stop_requested()) {
                    _exit(3);
                }
            });
        }
    }
    void made() { guard_.request_stop(); }

private:
    std::mutex mutex_;
    std::condition_variable_any made_;
    std::jthread guard_;
};

/// What \p method makes of the solids, in a process that is ended after so many seconds. A mesh that is made by then is
/// given some more to be checked for conformity and handed over.
MethodTry try_in_child(PartMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                       const PartOptions& options, double seconds) {
    using End = detail::ChildAnswer::End;
    const Stopwatch watch;
    const auto late = [&] { return seconds > 0 && watch.total() > 0.7 * seconds; };
    const auto no_time = [&] { return seconds > 0 && watch.total() > seconds; };
    const auto task = [&] {
        MadeInTime guard(seconds);
        const TryTimes times{late, no_time, [&] { guard.made(); }, seconds};
        return detail::to_bytes(try_method(method, model, solids, options, detail::gmsh_kernels(model), times));
    };
    const double to_check = seconds > 0 ? std::max(2.0, 0.2 * seconds) : 0;
    const detail::ChildAnswer answer =
        detail::run_in_child(task, {.seconds = seconds + to_check, .stop = options.execution.stop});
    if (answer.end == End::stopped) {
        throw Stopped();
    }
    MethodTry result;
    if (answer.end == End::answered) {
        result = detail::try_from_bytes(answer.bytes);
    } else {
        std::ostringstream reason;
        const bool late_answer = answer.end == End::timed_out || (answer.end == End::died && no_time());
        result.outcome = late_answer ? TryOutcome::timed_out : TryOutcome::died;
        if (late_answer) {
            reason << std::setprecision(3) << "not done after " << seconds << " s";
        } else {
            reason << "it " << answer.reason;
        }
        result.reason = reason.str();
        result.method = method;
    }
    result.seconds = watch.total();
    return result;
}

}  // namespace

PartMesh mesh_model(const GmshBrep& model, const PartOptions& options) {
    check_options(options);
    if (!options.allow_slices) {
        refuse_slices(model.imprint_report(), options.size > 0 ? options.size : model.diagonal() / 12);
    }
    PartMesh part =
        detail::mesh_groups(model, options,
                            [&](PartMethod method, std::span<const SolidId> solids, const PartOptions& own,
                                double seconds) { return try_in_child(method, model, solids, own, seconds); });
    part.warnings = warnings_of(model.imprint_report());
    return part;
}

PartMesh mesh_file(const std::filesystem::path& file, const PartOptions& options) {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    check_options(options);
    report(options.progress, "reading", 0);
    CadOptions cad;
    cad.imprint_tolerance = options.imprint_tolerance;
    cad.stop = options.execution.stop;
    return mesh_model(GmshBrep::load(file, cad), options);
}

}  // namespace pavior

#include <pavior/part/mesh_file.hpp>

#include "../common/child_process.hpp"
#include "gmsh_kernels.hpp"
#include "try_bytes.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/part/mesh_part.hpp>
#include <pavior/part/try_method.hpp>

#include <iomanip>
#include <mutex>
#include <sstream>

namespace pavior {

namespace {

/// What \p method makes of the solids, in a process that is ended after so many seconds.
MethodTry try_in_child(PartMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                       const PartOptions& options, double seconds) {
    using End = detail::ChildAnswer::End;
    const Stopwatch watch;
    const auto late = [&] { return seconds > 0 && watch.total() > 0.7 * seconds; };
    const auto task = [&] {
        return detail::to_bytes(try_method(method, model, solids, options, detail::gmsh_kernels(model), late));
    };
    const detail::ChildAnswer answer = detail::run_in_child(task, {.seconds = seconds, .stop = options.execution.stop});
    if (answer.end == End::stopped) {
        throw Stopped();
    }
    MethodTry result;
    if (answer.end == End::answered) {
        result = detail::try_from_bytes(answer.bytes);
    } else {
        std::ostringstream reason;
        const bool late_answer = answer.end == End::timed_out;
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
    return detail::mesh_groups(model, options,
                               [&](PartMethod method, std::span<const SolidId> solids, const PartOptions& own,
                                   double seconds) { return try_in_child(method, model, solids, own, seconds); });
}

PartMesh mesh_file(const std::filesystem::path& file, const PartOptions& options) {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    check_options(options);
    report(options.progress, "reading", 0);
    return mesh_model(GmshBrep::load(file), options);
}

}  // namespace pavior

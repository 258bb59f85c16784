#pragma once

#include <functional>
#include <string>

namespace pavior::cli {

/// What became of a task in a process of its own.
struct ChildAnswer {
    enum class End { answered, timed_out, died };
    End end = End::died;
    std::string bytes;   ///< what the task returned
    std::string reason;  ///< of its death
};

/// Runs \p task in a forked child that prints nothing, so that it can neither hang nor crash this process. The child
/// sees the memory of this process as it was and leaves no trace in it. To be called while there are no other threads.
/// \param seconds  the child is killed after that time; 0: never
[[nodiscard]] ChildAnswer run_in_child(const std::function<std::string()>& task, double seconds);

}  // namespace pavior::cli

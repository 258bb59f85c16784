#pragma once
// Foreign code in a process of its own: it may crash, hang, print or call exit(). Internal to the tetra component.

#include <pavior/core/error.hpp>

#include "plc.hpp"

#include <functional>

namespace pavior::detail {

/// The child was still at work when its time was over.
class TimeOut : public Error {
public:
    using Error::Error;
};

/// Runs \p task in a forked child, whose standard output and error go nowhere, and returns what it returned.
/// The child sees the memory of this process as it was, and never returns into it. Safe to call from several threads
/// as far as \p task needs nothing but memory.
/// \param seconds  the child is ended after that time
/// \throws Error(tetrahedra_failed): what the task threw, or how the child died; TimeOut (the same code)
[[nodiscard]] RawTets run_in_child(const std::function<RawTets()>& task, double seconds);

}  // namespace pavior::detail

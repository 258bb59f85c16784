#pragma once
/// \file
/// How a long call is stopped: the caller asks by a std::stop_source, the call ends by an exception.

#include <exception>
#include <stop_token>

namespace pavior {

/// Thrown by a call that was asked to stop. What the call was to write in place is as before the call, unless its
/// comment says otherwise; nothing else is left behind. No Error, since nothing went wrong: code that catches Error to
/// try another way must let it pass.
class Stopped : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "stopped: the caller asked for it"; }
};

/// Ends the call if \p stop asks for it; a token without a source never does. A read of one atomic: cheap enough for
/// each item of work that takes a microsecond. Thread-safe. \throws Stopped
inline void check_stop(const std::stop_token& stop) {
    if (stop.stop_requested()) {
        throw Stopped();
    }
}

}  // namespace pavior

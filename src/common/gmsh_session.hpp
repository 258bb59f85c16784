#pragma once
// Gmsh keeps one global state. Sessions count their users, so that io and cad can share it within one process.

#include <pavior/core/error.hpp>

#include <gmsh.h>

#include <exception>
#include <string>

namespace pavior::detail {

/// Keeps Gmsh initialised and silent while at least one session lives. Not thread-safe.
class GmshSession {
public:
    GmshSession() {
        if (users_++ == 0) {
            gmsh::initialize(0, nullptr, false);
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::option::setNumber("General.NumThreads", 1);
        }
    }
    GmshSession(const GmshSession&) : GmshSession() {}
    GmshSession& operator=(const GmshSession&) = default;
    ~GmshSession() {
        if (--users_ == 0) {
            gmsh::finalize();
        }
    }

private:
    inline static int users_ = 0;
};

/// A model of its own; the model that was current before is current again afterwards.
class GmshScratchModel {
public:
    explicit GmshScratchModel(const std::string& name) {
        gmsh::model::getCurrent(previous_);
        gmsh::model::add(name);
    }
    GmshScratchModel(const GmshScratchModel&) = delete;
    GmshScratchModel& operator=(const GmshScratchModel&) = delete;
    ~GmshScratchModel() {
        gmsh::model::remove();
        gmsh::model::setCurrent(previous_);
    }

private:
    GmshSession session_;
    std::string previous_;
};

/// What Gmsh said last, after it threw (it throws integers, strings or exceptions).
inline std::string last_gmsh_error() {
    std::string message;
    gmsh::logger::getLastError(message);
    return message.empty() ? "no reason given" : message;
}

/// Runs \p body; whatever Gmsh throws is handed to fail(message), which must throw. Our own errors pass through.
template <class Body, class Fail>
auto with_gmsh(Body&& body, Fail&& fail) -> decltype(body()) {
    try {
        return body();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(std::string(error.what()));
    } catch (...) {
        fail(last_gmsh_error());
    }
    throw;  // unreachable: fail throws
}

}  // namespace pavior::detail

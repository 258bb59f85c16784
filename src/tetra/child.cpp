#include "child.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pavior::detail {

namespace {

[[noreturn]] void fail(const std::string& reason) { throw Error(ErrorCode::tetrahedra_failed, reason); }

/// Both ends of a pipe, closed at the end of the scope.
class Pipe {
public:
    Pipe() {
        if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
            fail("no pipe: " + std::string(std::strerror(errno)));
        }
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    void close_end(std::size_t end) {
        if (ends_[end] >= 0) {
            ::close(std::exchange(ends_[end], -1));
        }
    }
    [[nodiscard]] int end(std::size_t which) const { return ends_[which]; }

private:
    std::array<int, 2> ends_{-1, -1};
};

// ---- in the child -------------------------------------------------------------------------------------------------

void send(int descriptor, const void* data, std::size_t bytes) {
    const auto* at = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t sent = ::write(descriptor, at, bytes);
        if (sent < 0 && errno != EINTR) {
            _exit(2);
        }
        at += std::max<ssize_t>(sent, 0);
        bytes -= static_cast<std::size_t>(std::max<ssize_t>(sent, 0));
    }
}

template <class Array>
void send_array(int descriptor, const Array& array) {
    const std::uint64_t count = array.size();
    send(descriptor, &count, sizeof count);
    send(descriptor, array.data(), array.size() * sizeof(typename Array::value_type));
}

/// The message: an error text (empty: none), then the arrays.
void send_result(int descriptor, const std::string& error, const RawTets& raw) {
    send_array(descriptor, error);
    send_array(descriptor, raw.nodes);
    send_array(descriptor, raw.tets);
    send_array(descriptor, raw.facets);
    send_array(descriptor, raw.facet_numbers);
    send_array(descriptor, raw.edges);
    send_array(descriptor, raw.edge_numbers);
}

/// Foreign code must neither talk, nor leave a core file, nor run what this process registered for its own end.
void become_quiet() {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGTERM}) {
        std::signal(signal, SIG_DFL);
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::atexit([] { _exit(3); });
    std::srand(1);  // NOLINT: the same state whatever the caller did
}

[[noreturn]] void be_child(const std::function<RawTets()>& task, int descriptor) {
    become_quiet();
    RawTets raw;
    std::string error;
    try {
        raw = task();
    } catch (const Error& caught) {
        error = caught.what();
        error.erase(0, to_string(caught.code()).size() + 2);
    } catch (const std::exception& caught) {
        error = caught.what();
    } catch (...) {
        error = "something unknown was thrown";
    }
    send_result(descriptor, error, raw);
    _exit(0);
}

// ---- in the parent ------------------------------------------------------------------------------------------------

using Clock = std::chrono::steady_clock;

/// The child as seen from here; killed and collected at the end of the scope.
class Child {
public:
    Child(pid_t id, int descriptor, double seconds)
        : id_(id),
          descriptor_(descriptor),
          end_(Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, 1e8)))) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (!collected_) {
            kill(id_, SIGKILL);
            collect(0);
        }
    }

    /// Reads exactly so many bytes.
    void receive(void* data, std::size_t bytes) {
        auto* at = static_cast<char*>(data);
        while (bytes > 0) {
            const std::size_t got = receive_some(at, bytes);
            at += got;
            bytes -= got;
        }
    }

    template <class Array>
    void receive_array(Array& array) {
        std::uint64_t count = 0;
        receive(&count, sizeof count);
        array.resize(count);
        receive(array.data(), array.size() * sizeof(typename Array::value_type));
    }

private:
    std::size_t receive_some(char* data, std::size_t bytes) {
        for (;;) {
            if (Clock::now() > end_) {
                throw TimeOut(ErrorCode::tetrahedra_failed, "no result within the time limit");
            }
            pollfd wait{descriptor_, POLLIN, 0};
            // Another thread's child may hold the pipe open after this one died: look after it now and then.
            const int ready = poll(&wait, 1, collected_ ? 0 : 100);
            const ssize_t got = ready > 0 ? ::read(descriptor_, data, bytes) : -1;
            if (got > 0) {
                return static_cast<std::size_t>(got);
            }
            if (got == 0) {
                collect(0);
            }
            if (got == 0 || (ready == 0 && collected_)) {
                died();
            }
            if (ready == 0) {
                collect(WNOHANG);  // what it wrote before is still in the pipe
                continue;
            }
        }
    }

    void collect(int options) {
        pid_t got = collected_ ? id_ : 0;
        while (!collected_ && (got = waitpid(id_, &status_, options)) < 0 && errno == EINTR) {
        }
        collected_ = got != 0;
    }

    [[noreturn]] void died() const {
        if (WIFSIGNALED(status_)) {
            fail("crashed (signal " + std::to_string(WTERMSIG(status_)) + ")");
        }
        fail("ended itself (status " + std::to_string(WIFEXITED(status_) ? WEXITSTATUS(status_) : -1) + ")");
    }

    pid_t id_;
    int descriptor_;
    Clock::time_point end_;
    int status_ = 0;
    bool collected_ = false;
};

}  // namespace

RawTets run_in_child(const std::function<RawTets()>& task, double seconds) {
    Pipe pipe;
    const pid_t id = fork();
    if (id < 0) {
        fail("no child process: " + std::string(std::strerror(errno)));
    }
    if (id == 0) {
        be_child(task, pipe.end(1));
    }
    pipe.close_end(1);
    Child child(id, pipe.end(0), seconds);
    std::string error;
    RawTets raw;
    child.receive_array(error);
    child.receive_array(raw.nodes);
    child.receive_array(raw.tets);
    child.receive_array(raw.facets);
    child.receive_array(raw.facet_numbers);
    child.receive_array(raw.edges);
    child.receive_array(raw.edge_numbers);
    if (!error.empty()) {
        fail(error);
    }
    return raw;
}

}  // namespace pavior::detail

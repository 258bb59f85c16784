#pragma once
// A task in a process of its own: it may crash, hang, print or call exit().

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pavior::detail {

/// What became of a task in a process of its own.
struct ChildAnswer {
    enum class End { answered, threw, timed_out, stopped, heard, died };
    End end = End::died;
    std::string bytes;   ///< what the task returned
    std::string reason;  ///< what it threw, or how it died
    std::string said;    ///< what it printed, if ChildLimits::heard_enough listens
};

/// When a task in a process of its own is ended.
struct ChildLimits {
    double seconds = 0;         ///< after that time; 0: never
    std::stop_token stop = {};  ///< when this asks for it, within some 20 ms
    /// And when this says so of all that it has printed; unset: nobody listens.
    std::function<bool(const std::string& said)> heard_enough = {};
};

/// Both ends of a pipe, closed at the end of the scope.
class Pipe {
public:
    Pipe() : open_(pipe2(ends_.data(), O_CLOEXEC) == 0) {}
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        close_end(0);
        close_end(1);
    }
    [[nodiscard]] bool is_open() const { return open_; }
    [[nodiscard]] int end(std::size_t which) const { return ends_[which]; }
    void close_end(std::size_t which) {
        if (ends_[which] >= 0) {
            ::close(std::exchange(ends_[which], -1));
        }
    }

private:
    std::array<int, 2> ends_{-1, -1};
    bool open_;
};

/// The side of the child: never returns into what it was forked from.
class ChildSide {
public:
    /// Standard output and error go to \p output, nowhere if that is negative.
    [[noreturn]] static void run(const std::function<std::string()>& task, int descriptor, int output) {
        become_quiet(output);
        char kind = 'a';
        std::string bytes;
        try {
            bytes = task();
        } catch (const std::exception& caught) {
            kind = 't';
            bytes = caught.what();
        } catch (...) {
            kind = 't';
            bytes = "something unknown was thrown";
        }
        std::fflush(stdout);
        const std::uint64_t size = bytes.size();
        send(descriptor, &kind, 1);
        send(descriptor, &size, sizeof size);
        send(descriptor, bytes.data(), bytes.size());
        _exit(0);
    }

private:
    /// Foreign code must neither talk, nor leave a core file, nor run what this process registered for its own end. An
    /// interrupt from the keyboard is for the parent, which ends the child.
    static void become_quiet(int output) {
        const int to = output >= 0 ? output : ::open("/dev/null", O_RDWR | O_CLOEXEC);
        if (to >= 0) {
            dup2(to, STDOUT_FILENO);
            dup2(to, STDERR_FILENO);
        }
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGTERM}) {
            std::signal(signal, SIG_DFL);
        }
        std::signal(SIGINT, SIG_IGN);
        sigset_t none;
        sigemptyset(&none);
        sigprocmask(SIG_SETMASK, &none, nullptr);
        std::atexit([] { _exit(3); });
        std::srand(1);  // NOLINT: the same state whatever the caller did
    }

    static void send(int descriptor, const void* data, std::size_t bytes) {
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
};

/// The side of the parent; the child is killed and collected at the end of the scope.
class ParentSide {
public:
    using Clock = std::chrono::steady_clock;

    /// \p output: what the child prints comes here; negative: nowhere
    ParentSide(pid_t id, int descriptor, int output, const ChildLimits& limits)
        : id_(id), descriptor_(descriptor), output_(output), limits_(limits) {
        if (limits.seconds > 0) {
            const std::chrono::duration<double> limit(std::min(limits.seconds, 1e8));
            end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
        }
    }
    ParentSide(const ParentSide&) = delete;
    ParentSide& operator=(const ParentSide&) = delete;
    ~ParentSide() {
        if (!collected_) {
            kill(id_, SIGKILL);
            collect(0);
        }
    }

    [[nodiscard]] ChildAnswer listen() {
        char kind = 0;
        std::uint64_t size = 0;
        if (receive(&kind, 1) && receive(&size, sizeof size)) {
            answer_.bytes.resize(size);
            if (receive(answer_.bytes.data(), size)) {
                answer_.end = kind == 'a' ? ChildAnswer::End::answered : ChildAnswer::End::threw;
            }
        }
        while (answer_.end != ChildAnswer::End::heard && hear()) {  // what was printed last
        }
        if (answer_.end == ChildAnswer::End::threw) {
            answer_.reason = std::exchange(answer_.bytes, std::string());
        }
        return std::move(answer_);
    }

private:
    /// Reads exactly so many bytes, unless the child dies or the time is over before.
    bool receive(void* data, std::size_t bytes) {
        auto* at = static_cast<char*>(data);
        while (bytes > 0) {
            if (limits_.stop.stop_requested()) {
                answer_.end = ChildAnswer::End::stopped;
                return false;
            }
            if (end_ && Clock::now() > *end_) {
                answer_.end = ChildAnswer::End::timed_out;
                return false;
            }
            std::array<pollfd, 2> wait{{{descriptor_, POLLIN, 0}, {output_, POLLIN, 0}}};
            // Another thread's child may hold the pipe open after this one died: look after it now and then.
            const int ready = ::poll(wait.data(), wait.size(), collected_ ? 0 : 20);
            hear();
            if (answer_.end == ChildAnswer::End::heard) {
                return false;
            }
            if (ready > 0 && wait[0].revents == 0) {
                continue;
            }
            const ssize_t got = ready > 0 ? ::read(descriptor_, at, bytes) : -1;
            if (got > 0) {
                at += got;
                bytes -= static_cast<std::size_t>(got);
            } else if (got == 0 || (ready == 0 && collected_)) {
                collect(0);
                return died();
            } else if (ready == 0) {
                collect(WNOHANG);  // what it wrote before is still in the pipe
            }
        }
        return true;
    }

    /// Takes what the child has printed; false if there is nothing more, for now or for ever.
    bool hear() {
        pollfd wait{output_, POLLIN, 0};
        if (output_ < 0 || ::poll(&wait, 1, 0) <= 0) {
            return false;
        }
        std::array<char, 4096> buffer{};
        const ssize_t got = ::read(output_, buffer.data(), buffer.size());
        if (got <= 0) {
            output_ = got == 0 ? -1 : output_;
            return false;
        }
        answer_.said.append(buffer.data(), static_cast<std::size_t>(got));
        if (limits_.heard_enough(answer_.said)) {
            answer_.end = ChildAnswer::End::heard;
            return false;
        }
        return true;
    }

    void collect(int options) {
        pid_t got = collected_ ? id_ : 0;
        while (!collected_ && (got = waitpid(id_, &status_, options)) < 0 && errno == EINTR) {
        }
        collected_ = got != 0;
    }

    bool died() {
        answer_.end = ChildAnswer::End::died;
        answer_.reason =
            WIFSIGNALED(status_)
                ? "crashed (signal " + std::to_string(WTERMSIG(status_)) + ")"
                : "ended itself (status " + std::to_string(WIFEXITED(status_) ? WEXITSTATUS(status_) : -1) + ")";
        return false;
    }

    pid_t id_;
    int descriptor_;
    int output_;
    const ChildLimits& limits_;
    std::optional<Clock::time_point> end_;
    ChildAnswer answer_;
    int status_ = 0;
    bool collected_ = false;
};

/// Runs \p task in a forked child and tells what became of it. The child sees the memory of this process as it was and
/// leaves no trace in it; it ends with the thread that called this. Safe to call from several threads as far as \p task
/// needs nothing but memory.
inline ChildAnswer run_in_child(const std::function<std::string()>& task, const ChildLimits& limits) {
    Pipe pipe;
    std::optional<Pipe> output;
    if (limits.heard_enough) {
        output.emplace();
    }
    const bool open = pipe.is_open() && (!output || output->is_open());
    const pid_t parent = getpid();
    const pid_t id = open ? fork() : -1;
    if (id < 0) {
        ChildAnswer answer;
        answer.reason = std::string(open ? "had no process: " : "had no pipe: ").append(std::strerror(errno));
        return answer;
    }
    if (id == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) {
            _exit(2);
        }
        pipe.close_end(0);
        ChildSide::run(task, pipe.end(1), output ? output->end(1) : -1);
    }
    pipe.close_end(1);
    if (output) {
        output->close_end(1);
    }
    return ParentSide(id, pipe.end(0), output ? output->end(0) : -1, limits).listen();
}

}  // namespace pavior::detail

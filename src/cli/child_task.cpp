#include "child_task.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pavior::cli {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void be_child(const std::function<std::string()>& task, int descriptor) {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::string bytes;
    try {
        bytes = task();
    } catch (...) {
        _exit(3);  // tasks tell their errors in what they return
    }
    const std::uint64_t size = bytes.size();
    bytes.insert(0, reinterpret_cast<const char*>(&size), sizeof size);
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t n = ::write(descriptor, bytes.data() + sent, bytes.size() - sent);
        if (n < 0 && errno != EINTR) {
            _exit(2);
        }
        sent += static_cast<std::size_t>(std::max<ssize_t>(n, 0));
    }
    _exit(0);
}

/// Milliseconds that poll() may wait: -1 for ever, 0 when the time is over.
int wait_of(const std::optional<Clock::time_point>& end) {
    if (!end) {
        return -1;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(*end - Clock::now()).count();
    return static_cast<int>(std::clamp<std::int64_t>(left + (left > 0 ? 1 : 0), 0, 1000000));
}

/// Reads exactly so many bytes. False: the other end closed too early. Nothing: the time is over.
std::optional<bool> receive(int descriptor, char* data, std::size_t bytes,
                            const std::optional<Clock::time_point>& end) {
    while (bytes > 0) {
        pollfd wait{descriptor, POLLIN, 0};
        const int ready = ::poll(&wait, 1, wait_of(end));
        if (ready == 0 && end && Clock::now() >= *end) {
            return std::nullopt;
        }
        if (ready <= 0) {
            continue;
        }
        const ssize_t got = ::read(descriptor, data, bytes);
        if (got == 0) {
            return false;
        }
        data += std::max<ssize_t>(got, 0);
        bytes -= static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    }
    return true;
}

/// The answer of the child at the other end of the pipe, or how far it came.
ChildAnswer listen(int descriptor, const std::optional<Clock::time_point>& end) {
    ChildAnswer answer;
    std::uint64_t size = 0;
    std::array<char, sizeof size> head{};
    std::optional<bool> got = receive(descriptor, head.data(), head.size(), end);
    if (got && *got) {
        std::memcpy(&size, head.data(), sizeof size);
        answer.bytes.resize(size);
        got = receive(descriptor, answer.bytes.data(), size, end);
    }
    answer.end = !got ? ChildAnswer::End::timed_out : *got ? ChildAnswer::End::answered : ChildAnswer::End::died;
    return answer;
}

std::string cause_of_death(int status) {
    if (WIFSIGNALED(status)) {
        return "it crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
    }
    return "it ended itself (status " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) + ")";
}

}  // namespace

ChildAnswer run_in_child(const std::function<std::string()>& task, double seconds) {
    std::optional<Clock::time_point> end;
    if (seconds > 0) {
        const std::chrono::duration<double> limit(std::min(seconds, 1e8));
        end = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
    }
    ChildAnswer answer;
    std::array<int, 2> pipe{-1, -1};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0) {
        answer.reason = std::string("no pipe: ").append(std::strerror(errno));
        return answer;
    }
    const pid_t id = fork();
    if (id == 0) {
        ::close(pipe[0]);
        be_child(task, pipe[1]);
    }
    ::close(pipe[1]);
    if (id < 0) {
        answer.reason = std::string("no child process: ").append(std::strerror(errno));
        ::close(pipe[0]);
        return answer;
    }
    answer = listen(pipe[0], end);
    ::close(pipe[0]);
    if (answer.end == ChildAnswer::End::timed_out) {
        kill(id, SIGKILL);
    }
    int status = 0;
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
    }
    if (answer.end == ChildAnswer::End::died) {
        answer.reason = cause_of_death(status);
    }
    return answer;
}

}  // namespace pavior::cli

#include "support/catch.hpp"

#include <pavior/core/assert.hpp>

#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>

namespace {
// The signal that ends a process in which the assertion is made, 0 if it survives.
int signal_of(bool condition) {
    const pid_t child = fork();
    if (child == 0) {
        static_cast<void>(std::signal(SIGABRT, SIG_DFL));
        static_cast<void>(std::freopen("/dev/null", "w", stderr));
        PAVIOR_ASSERT(condition);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}
}  // namespace

TEST_CASE("an assertion that holds does nothing, another aborts where assertions are on") {
    CHECK(signal_of(true) == 0);
#ifdef NDEBUG
    CHECK(signal_of(false) == 0);
#else
    CHECK(signal_of(false) == SIGABRT);
#endif
}

#pragma once
// The program pavior, run as its users run it.

#include "support/scratch.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>

namespace pavior::test {

/// How a run of the program ended and what it printed.
struct ProgramRun {
    int code = -1;  ///< exit code, -1: killed
    std::string out, err;
};

inline std::string content(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

inline nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(content(file)); }

/// Runs pavior with \p arguments, as a shell splits them, after what \p before has the shell do.
inline ProgramRun run_program(const std::string& arguments, const std::string& before = "") {
    const std::string out = scratch_file("stdout.txt");
    const std::string err = scratch_file("stderr.txt");
    std::string command = before + " exec " + PAVIOR_PROGRAM;
    command.append(" ").append(arguments).append(" >").append(out).append(" 2>").append(err).append(" </dev/null");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

}  // namespace pavior::test

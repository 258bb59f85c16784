#pragma once
// The program pavior, run as its users run it.

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace pavior::test {

/// How a run of the program ended and what it printed.
struct ProgramRun {
    int code = -1;  ///< exit code, -1: killed
    std::string out, err;
};

/// A directory of this process, for the files of its tests.
inline std::filesystem::path scratch() {
    static const std::filesystem::path directory = [] {
        const auto d =
            std::filesystem::temp_directory_path() / std::string("pavior_tests_").append(std::to_string(::getpid()));
        std::filesystem::create_directories(d);
        return d;
    }();
    return directory;
}

inline std::string scratch_file(const std::string& name) { return (scratch() / name).string(); }

inline std::string content(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

inline nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(content(file)); }

/// Runs pavior with \p arguments, as a shell splits them.
inline ProgramRun run_program(const std::string& arguments) {
    const std::string out = scratch_file("stdout.txt");
    const std::string err = scratch_file("stderr.txt");
    std::string command = PAVIOR_PROGRAM;
    command.append(" ").append(arguments).append(" >").append(out).append(" 2>").append(err).append(" </dev/null");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

}  // namespace pavior::test

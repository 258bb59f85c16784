#pragma once
// Where tests write files.

#include <filesystem>
#include <string>

#include <unistd.h>

namespace pavior::test {

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

}  // namespace pavior::test

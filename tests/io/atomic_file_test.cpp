#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/atomic_file.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace pavior;
namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("write_atomically puts the whole file in place, or leaves the old one") {
    const fs::path directory = fs::temp_directory_path() / "pavior_atomic_file_test";
    fs::remove_all(directory);
    fs::create_directories(directory);
    const std::string file = directory / "a.txt";

    std::string used;
    write_atomically(file, [&](const std::string& temporary) {
        used = temporary;
        std::ofstream(temporary) << "first";
        CHECK_FALSE(fs::exists(file));
    });
    CHECK(content(file) == "first");
    CHECK(fs::path(used).extension() == ".txt");

    CHECK_THROWS_WITH(write_atomically(file,
                                       [](const std::string& temporary) {
                                           std::ofstream(temporary) << "half";
                                           throw std::runtime_error("stopped");
                                       }),
                      "stopped");
    CHECK(content(file) == "first");
    CHECK_THROWS_AS(write_atomically(file, [](const std::string&) {}), FileError);
    CHECK(content(file) == "first");
    CHECK_THROWS_AS(write_atomically(directory, [](const std::string&) {}), FileError);
    CHECK_THROWS_AS(write_atomically(directory / "none" / "a.txt", [](const std::string&) {}), FileError);
    CHECK(std::distance(fs::directory_iterator(directory), {}) == 1);
    fs::remove_all(directory);
}

#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/atomic_file.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

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

TEST_CASE("an AtomicFile appears at commit, through links, and errors name the file itself") {
    const fs::path directory = fs::temp_directory_path() / "pavior_atomic_file_links";
    fs::remove_all(directory);
    fs::create_directories(directory / "sub");
    const auto put = [](const std::string& text) {
        return [text](const std::string& temporary) { std::ofstream(temporary) << text; };
    };
    const auto count = [&] { return std::distance(fs::recursive_directory_iterator(directory), {}); };

    fs::create_symlink("sub/real.txt", directory / "link.txt");
    fs::create_symlink("link.txt", directory / "again.txt");
    {
        AtomicFile file(directory / "again.txt");
        file.write(put("first"));
        CHECK_FALSE(fs::exists(directory / "sub" / "real.txt"));
        file.commit();
    }
    CHECK(content(directory / "sub" / "real.txt") == "first");
    CHECK(fs::is_symlink(directory / "link.txt"));
    CHECK(fs::is_symlink(directory / "again.txt"));
    {
        const AtomicFile file(directory / "link.txt");
        file.write(put("second"));
    }
    CHECK(content(directory / "sub" / "real.txt") == "first");
    CHECK(count() == 4);

    fs::create_symlink("circle.txt", directory / "circle.txt");
    CHECK_THROWS_WITH(AtomicFile(directory / "circle.txt"), Catch::Contains("links"));
    CHECK_THROWS_WITH(AtomicFile("/dev/null"), Catch::Contains("no regular file"));

    const AtomicFile file(directory / "named.txt");
    try {
        file.write([](const std::string& temporary) { throw FileError(temporary, "is full", {3}); });
        FAIL("the error is passed on");
    } catch (const FileError& error) {
        CHECK(error.file() == (directory / "named.txt").string());
        CHECK(std::string(error.what()).find("named.txt: is full") != std::string::npos);
        CHECK(error.ids() == Error::Ids{3});
    }
    fs::remove_all(directory);
}

TEST_CASE("unfinished files can be discarded from outside, and then never get into place") {
    const fs::path directory = fs::temp_directory_path() / "pavior_atomic_file_discard";
    fs::remove_all(directory);
    fs::create_directories(directory);
    const pid_t id = fork();  // in a process of its own, since that is the end of all files
    if (id == 0) {
        AtomicFile file((directory / "a.txt").string());
        file.write([](const std::string& temporary) { std::ofstream(temporary) << "half"; });
        discard_unfinished_files();
        bool refused = false;
        try {
            file.commit();
        } catch (const FileError&) {
            refused = true;
        }
        _exit(refused ? 0 : 1);
    }
    int status = 0;
    waitpid(id, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(fs::is_empty(directory));
    fs::remove_all(directory);
}

// What the program writes is whole and destroys nothing; how it ends when it is told to.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace pavior;
using namespace pavior::test;
namespace fs = std::filesystem;

namespace {

const std::string part = std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/4-4-19.step";

/// An empty directory, and what lies in it.
class Directory {
public:
    explicit Directory(const std::string& name) : path_(scratch() / name) {
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return path_ / name; }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : fs::directory_iterator(path_)) {
            result.push_back(entry.path().filename());
        }
        std::sort(result.begin(), result.end());
        return result;
    }

private:
    fs::path path_;
};

/// Starts the program with \p arguments and sends it \p signal after so many seconds.
int code_after_signal(const std::vector<std::string>& arguments, int signal, double seconds) {
    const pid_t id = fork();
    if (id == 0) {
        const int nowhere = ::open("/dev/null", O_RDWR);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        std::vector<char*> argv{const_cast<char*>("pavior")};
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        execv(PAVIOR_PROGRAM, argv.data());
        _exit(99);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(id, signal);
    int status = 0;
    waitpid(id, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Processes of this program that are still there.
bool any_left(const std::string& mark) {
    for (const auto& entry : fs::directory_iterator("/proc")) {
        std::ifstream file(entry.path() / "cmdline", std::ios::binary);
        std::string line((std::istreambuf_iterator<char>(file)), {});
        if (line.find(mark) != std::string::npos && entry.path().filename() != std::to_string(getpid())) {
            return true;
        }
    }
    return false;
}

}  // namespace

TEST_CASE("a report or a dual that would replace the input or the mesh is refused before work begins") {
    const Directory here("same");
    const std::string input = here.file("part.step");
    fs::copy_file(part, input);
    const std::string before = content(input);
    fs::create_symlink("part.step", here.file("link.json"));
    fs::create_hard_link(input, here.file("hard.json"));
    fs::create_symlink("m.vtu", here.file("dangling.json"));
    const std::string mesh = here.file("m.vtu");
    const auto refused = [&](const std::string& options) {
        const ProgramRun run = run_program(options);
        CAPTURE(options, run.err);
        CHECK(run.code == 2);
        CHECK(content(input) == before);
        CHECK_FALSE(fs::exists(mesh));
    };
    const std::string sweep = "sweep " + input + " --size 3 -o " + mesh;
    refused(sweep + " --report " + input);
    refused(sweep + " --report " + here.file("../same/part.step"));
    refused(sweep + " --report " + here.file("link.json"));
    refused(sweep + " --report " + here.file("hard.json"));
    refused(sweep + " --report " + mesh);
    refused(sweep + " --report " + here.file("dangling.json"));
    refused(sweep + " --report " + here.file("none/r.json"));
    refused("mesh " + input + " --size 3 -o " + mesh + " --report " + input);
    refused("mesh " + input + " --size 3 -o " + here.file("none/m.vtu"));
    refused("mesh " + input + " --size 3 -o /dev/null");
    refused("block " + input + " -o " + mesh + " --dual " + mesh);
    refused("block " + input + " -o " + mesh + " --dual " + here.file("d.vtu") + " --report " + here.file("d.vtu"));
    CHECK(here.names() == std::vector<std::string>{"dangling.json", "hard.json", "link.json", "part.step"});

    REQUIRE(run_program(sweep + " --quiet").code == 0);
    const std::string made = content(mesh);
    CHECK(run_program("quality " + mesh + " --report " + mesh).code == 2);
    CHECK(content(mesh) == made);
}

TEST_CASE("a link given as output is written through") {
    const Directory here("through");
    const std::string link = here.file("link.vtu");
    fs::create_symlink("real.vtu", link);
    REQUIRE(run_program("sweep " + part + " --size 3 --quiet -o " + link).code == 0);
    CHECK(fs::is_symlink(link));
    CHECK(read_mesh(here.file("real.vtu")).mesh.hexes.size() > 0);
    const std::string first = content(here.file("real.vtu"));
    REQUIRE(run_program("sweep " + part + " --size 2 --quiet -o " + link).code == 0);
    CHECK(fs::is_symlink(link));
    CHECK(content(here.file("real.vtu")) != first);
    CHECK(here.names() == std::vector<std::string>{"link.vtu", "real.vtu"});
}

TEST_CASE("a disk that is full fails the run and leaves nothing, in every format") {
    const Directory here("full");
    for (const std::string name : {"m.vtu", "m.vtk", "m.msh", "m.inp"}) {
        const std::string mesh = here.file(name);
        const std::string sweep = "sweep " + part + " --size 1 --quiet -o " + mesh;
        REQUIRE(run_program(sweep).code == 0);
        const auto blocks = (fs::file_size(mesh) + 511) / 512;
        fs::remove(mesh);
        for (const std::uintmax_t limit : {std::uintmax_t{0}, std::uintmax_t{8}, blocks / 2, blocks - 1}) {
            const ProgramRun run = run_program(sweep, "ulimit -f " + std::to_string(limit) + ";");
            CAPTURE(name, limit, blocks, run.err);
            CHECK(run.code == 2);
            CHECK(here.names().empty());
        }
    }
    // The mesh would fit, its report does not: then there is no mesh either.
    const std::string report = " --report " + here.file("r.json");
    const std::string small = "sweep " + part + " --size 100 --layers 1 --quiet -o " + here.file("s.vtu");
    REQUIRE(run_program(small + report).code == 0);
    const auto mesh_size = (fs::file_size(here.file("s.vtu")) + 511) / 512;
    const auto report_size = (fs::file_size(here.file("r.json")) + 511) / 512;
    CAPTURE(mesh_size, report_size);
    fs::remove(here.file("s.vtu"));
    fs::remove(here.file("r.json"));
    const auto limit = std::min(mesh_size, report_size) - 1;
    CHECK(run_program(small + report, "ulimit -f " + std::to_string(limit) + ";").code == 2);
    CHECK(here.names().empty());
}

TEST_CASE("a run that is told to end leaves no file and no process, and says so by its code") {
    const Directory here("signals");
    REQUIRE(setenv("TMPDIR", here.file("").c_str(), 1) == 0);  // what is passed to children goes there
    const std::string mesh = here.file("unfinished.vtu");
    const std::string model = std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/10-11-11-11-11-23.step";
    for (const double seconds : {0.1, 0.7, 2.0}) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            CAPTURE(seconds, signal);
            const int code = code_after_signal(
                {"mesh", model, "--size", "0.2", "--method", "block", "-o", mesh, "--timeout", "0"}, signal, seconds);
            const bool before_main = code == -signal && seconds < 1;  // libraries were still being loaded
            CHECK((code == 128 + signal || before_main));
            CHECK(here.names().empty());
            CHECK_FALSE(any_left(mesh));
        }
    }
    unsetenv("TMPDIR");
}

TEST_CASE("--timeout holds for the whole program, whatever it does") {
    const Directory here("timeout");
    const std::string model = std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/10-11-11-11-11-23.step";
    const std::string report = here.file("r.json");
    for (const std::string command : {"mesh --method block ", "block "}) {
        const auto begin = std::chrono::steady_clock::now();
        const ProgramRun run =
            run_program(command + model + " --size 0.2 --timeout 1.5 -o " + here.file("m.vtu") + " --report " + report);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        CAPTURE(command, run.err, took.count());
        CHECK(run.code == 3);
        CHECK(run.err.find("1.5 s") != std::string::npos);
        CHECK(took.count() < 15);
        CHECK(json_of(report)["exit_code"] == 3);
        CHECK(here.names() == std::vector<std::string>{"r.json"});
    }
    CHECK(run_program("sweep " + part + " --size 0.02 --max-hexahedra 0 --timeout 0.5 -o " + here.file("m.vtu")).code ==
          3);
}

// What the options admit, and what is said of the rest.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

using namespace pavior;
using namespace pavior::test;

namespace {

std::string example(const std::string& name) { return std::string(PAVIOR_EXAMPLE_DATA) + "/" + name; }

const std::string part = example("mfcad/4-4-19.step");

/// Refused with exit code 2, a message that holds \p text, no number of more than twenty digits, and no mesh.
void check_refused(const std::string& arguments, const std::string& text) {
    const std::string mesh = scratch_file("refused_option.vtu");
    const ProgramRun run = run_program(arguments + " -o " + mesh);
    CAPTURE(arguments, run.err, run.out);
    CHECK(run.code == 2);
    CHECK((run.err + run.out).find(text) != std::string::npos);
    std::size_t digits = 0;
    std::size_t most = 0;
    for (const char c : run.err + run.out) {
        digits = c >= '0' && c <= '9' ? digits + 1 : 0;
        most = std::max(most, digits);
    }
    CHECK(most <= 20);
    CHECK_FALSE(std::filesystem::exists(mesh));
}

std::size_t hexahedra(const std::string& arguments) {
    const std::string mesh = scratch_file("sized.vtu");
    const ProgramRun run = run_program(arguments + " --quiet -o " + mesh);
    CAPTURE(arguments, run.err);
    REQUIRE(run.code == 0);
    return read_mesh(mesh).mesh.hexes.size();
}

}  // namespace

TEST_CASE("numbers out of range are refused in words") {
    for (const std::string command : {"mesh ", "sweep ", "block "}) {
        for (const std::string size : {"nan", "inf", "0", "-1", "1e400", "2x", "''"}) {
            check_refused(command + part + " --size " + size, "positive number");
        }
        check_refused(command + part + " --timeout nan", "number of seconds from 0 on");
        check_refused(command + part + " --threads -1", "whole number from 0 to 4096");
        check_refused(command + part + " --threads 1.5", "whole number");
        check_refused(command + part + " --local-size face:1", "KIND:TAG=H or NAME=H expected");
        check_refused(command + part + " --local-size face:1=nan", "H a positive number");
        check_refused(command + part + " --local-size face:1=-2", "H a positive number");
        check_refused(command + part + " --size 1 --local-size face:999=1", "face 999");
        check_refused(command + part + " --size 1 --local-size edge:999=1", "edge 999");
        check_refused(command + part + " --size 1 --local-size nobody=1", "nobody");
    }
    check_refused("mesh " + part + " --local-size solid:99=1", "solid 99");
    check_refused("sweep " + part + " --layers 0", "whole number from 1 to 1000000");
    check_refused("sweep " + part + " --layers 99999999999", "whole number from 1 to 1000000");
    check_refused("sweep " + part + " --layers nan", "whole number from 1 to 1000000");
    check_refused("sweep " + part + " --source x", "whole number");
    check_refused("block " + part + " --mu nan", "between 0 and 1/4");
    check_refused("block " + part + " --mu 0.3", "between 0 and 1/4");
    check_refused("block " + part + " --feature-angles 135,nan,315", "angle in degrees");
}

TEST_CASE("the version is told, an unknown command is named") {
    const ProgramRun version = run_program("--version");
    CHECK(version.code == 0);
    CHECK(version.out.rfind("pavior ", 0) == 0);
    const ProgramRun unknown = run_program("mehs part.step");
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("'mehs'") != std::string::npos);
    CHECK(unknown.err.find("mesh, sweep, block, quality") != std::string::npos);
    CHECK(run_program("").code == 2);
}

TEST_CASE("local sizes hold in every command, by tag and by name") {
    for (const std::string command : {"mesh ", "sweep ", "block "}) {
        CAPTURE(command);
        const std::string whole = command + part + " --size 4";
        const std::size_t coarse = hexahedra(whole);
        CHECK(hexahedra(whole + " --local-size face:1=1") > coarse);
        CHECK(hexahedra(whole + " --local-size edge:1=0.5") > coarse);
        CHECK(hexahedra(whole + " --local-size solid:1=1") > 8 * coarse);
    }
    const std::string assembly = example("assembly/bolt_plate_washer.step");
    for (const std::string command : {"mesh ", "sweep "}) {
        CAPTURE(command);
        const std::size_t coarse = hexahedra(command + assembly + " --size 3");
        CHECK(hexahedra(command + assembly + " --size 3 --local-size bolt=1") > coarse);
        CHECK(hexahedra(command + assembly + " --size 3 --local-size solid:1=1 --local-size face:3=1") > coarse);
    }
}

TEST_CASE("more hexahedra than the limit are refused at once, with a size that fits") {
    for (const std::string command : {"mesh ", "sweep ", "block "}) {
        check_refused(command + part + " --size 1e-4", "would fit");
        const ProgramRun run =
            run_program(command + part + " --size 0.1 --max-hexahedra 1000 -o " + scratch_file("l.vtu"));
        CAPTURE(command, run.err);
        REQUIRE(run.code == 2);
        const std::size_t at = run.err.find("; size ");
        REQUIRE(at != std::string::npos);
        const double fits = std::stod(run.err.substr(at + 7));
        CHECK(fits > 0.1);
        CHECK(run_program(command + part + " --quiet --max-hexahedra 1000 --size " + std::to_string(fits) + " -o " +
                          scratch_file("l.vtu"))
                  .code == 0);
    }
    check_refused("sweep " + part + " --size 0.1 --layers 1000000", "would fit");
}

TEST_CASE("the report of a sweep states the size that was used") {
    const std::string report = scratch_file("size.json");
    const std::string sweep = "sweep " + part + " --quiet -o " + scratch_file("size.vtu") + " --report " + report;
    REQUIRE(run_program(sweep).code == 0);
    CHECK(json_of(report)["options"]["size"].get<double>() > 0);
    REQUIRE(run_program(sweep + " --size 2 --local-size face:1=1 --layers 3").code == 0);
    CHECK(json_of(report)["options"]["size"] == 2);
    CHECK(json_of(report)["options"]["layers"] == 3);
    CHECK(json_of(report)["options"]["local_sizes"]["face"]["1"] == 1);
}

TEST_CASE("warnings are sentences") {
    const ProgramRun run = run_program("sweep " + std::string(PAVIOR_TEST_DATA) + "/faults/two_components.json -o " +
                                       scratch_file("two.vtu"));
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(run.err.find("warning: the source consists of several sheets") != std::string::npos);
}

TEST_CASE("a sweep problem without quads is bad input") {
    check_refused("sweep " + std::string(PAVIOR_TEST_DATA) + "/faults/no_quads.json", "no_quads.json");
}

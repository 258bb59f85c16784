#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/sweep_problem_file.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/mesh/verify_report.hpp>
#include <pavior/sweep/verify_problem.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace pavior;

namespace {

std::string write(const std::string& text) {
    const auto file = std::filesystem::temp_directory_path() / "pavior_sweep_problem.json";
    std::ofstream(file) << text;
    return file;
}

const char* const cube = R"({"source_nodes": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "quads": [[0,1,2,3]],
    "target_nodes": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "loops": [[0,1,2,3]],
    "boundary_levels": [[[0,0,0],[1,0,0],[1,1,0],[0,1,0]], [[0,0,1],[1,0,1],[1,1,1],[0,1,1]]], "name": "ignored"})";

std::string with(const std::string& from, const std::string& to) {
    std::string text = cube;
    return write(text.replace(text.find(from), from.size(), to));
}

}  // namespace

TEST_CASE("a sweep problem is read from JSON") {
    const SweepProblem problem = read_sweep_problem(write(cube));
    CHECK(problem.layers == 1);
    CHECK(problem.quads.size() == 1);
    CHECK(problem.loops.nodes == std::vector<Index>{0, 1, 2, 3});
    CHECK(problem.target_nodes[2] == Vec3(1, 1, 1));
    CHECK(verify_problem(problem).empty());
}

TEST_CASE("loops are found where they are not given") {
    CHECK(read_sweep_problem(with(R"("loops": [[0,1,2,3]],)", "")).loops.nodes == std::vector<Index>{0, 1, 2, 3});
}

TEST_CASE("numbers that JSON lacks come as strings, ids that no mesh has as the largest id") {
    CHECK(std::isnan(read_sweep_problem(with("[0,0,0]", R"(["nan",0,0])")).source_nodes[0][0]));
    CHECK(std::isinf(read_sweep_problem(with("[0,0,0]", R"(["-inf",0,0])")).source_nodes[0][0]));
    CHECK(read_sweep_problem(with("\"quads\": [[0", "\"quads\": [[-1")).quads[0][0] == 4294967295U);
}

TEST_CASE("what is wrong with the file is said") {
    CHECK_THROWS_WITH(read_sweep_problem("/no/such/file.json"), Catch::Contains("/no/such/file.json"));
    CHECK_THROWS_AS(read_sweep_problem(std::filesystem::temp_directory_path()), FileError);
    CHECK_THROWS_WITH(read_sweep_problem(write("{")), Catch::Contains("is no JSON"));
    CHECK_THROWS_WITH(read_sweep_problem(write("[1]")), Catch::Contains("no JSON object"));
    CHECK_THROWS_WITH(read_sweep_problem(with("quads", "quods")), Catch::Contains("quads"));
    CHECK_THROWS_WITH(read_sweep_problem(with("[0,0,0]", "[0,0]")), Catch::Contains("source_nodes"));
    CHECK_THROWS_WITH(read_sweep_problem(with("[0,0,0]", "[0,0,\"x\"]")), Catch::Contains("source_nodes"));
    CHECK_THROWS_WITH(read_sweep_problem(with("\"quads\": [[0,1", "\"quads\": [[0,1.5")), Catch::Contains("quads"));
    CHECK_THROWS_AS(read_sweep_problem(with("\"loops\": [[0,1,2,3]]", "\"loops\": [[0,1,2]]")), InputError);
    CHECK(read_sweep_problem(with("\"name\"", "\"layers\": 1, \"name\"")).layers == 1);
    CHECK_THROWS_AS(read_sweep_problem(with("\"name\"", "\"layers\": 2, \"name\"")), InputError);
}

#pragma once
// Sweep problems with expected results, read from tests/data.
#include <pavior/sweep/problem.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace pavior::test {

struct SweepCase {
    std::string name;
    nlohmann::json json;
    SweepProblem problem;
    double tolerance = 0;
    std::vector<Index> inner;
};

[[nodiscard]] inline nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) {
        throw std::runtime_error("cannot open " + file.string());
    }
    return nlohmann::json::parse(in);
}

// "nan", "inf" and "-inf" stand for what JSON has no numbers for.
[[nodiscard]] inline double number(const nlohmann::json& value) {
    return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

[[nodiscard]] inline std::vector<Vec3> points(const nlohmann::json& list) {
    std::vector<Vec3> result;
    for (const auto& p : list) {
        result.emplace_back(number(p.at(0)), number(p.at(1)), number(p.at(2)));
    }
    return result;
}

[[nodiscard]] inline std::vector<std::vector<Vec3>> levels(const nlohmann::json& list) {
    std::vector<std::vector<Vec3>> result;
    for (const auto& level : list) {
        result.push_back(points(level));
    }
    return result;
}

[[nodiscard]] inline SweepProblem problem_of(const nlohmann::json& json) {
    QuadMesh source{points(json.at("source_nodes")), {}};
    for (const auto& q : json.at("quads")) {
        source.quads.push_back(q.get<QuadCorners>());
    }
    Loops loops;
    for (const auto& loop : json.at("loops")) {
        loops.add(loop.get<std::vector<Index>>());
    }
    return make_sweep_problem(source, points(json.at("target_nodes")), loops, levels(json.at("boundary_levels")));
}

[[nodiscard]] inline SweepCase read_sweep_case(const std::string& name) {
    SweepCase result;
    result.name = name;
    result.json = read_json(std::filesystem::path(PAVIOR_TEST_DATA) / "sweep" / (name + ".json"));
    result.problem = problem_of(result.json);
    result.tolerance = result.json.at("tol_abs").get<double>();
    result.inner = result.json.at("inner").get<std::vector<Index>>();
    return result;
}

// Names of all cases of kind "sweep".
[[nodiscard]] inline std::vector<std::string> sweep_case_names() {
    return {"h01_translation", "h05_one_hole", "h07_nonparallel_caps", "h20_cad_noise",
            "s35_flattening",  "s35_flipping", "s35_offset_scaling",   "s35_skewing"};
}

// Largest distance between the inner nodes of levels 1 .. r - 1 and the expected ones.
template <class LevelOf>
[[nodiscard]] double deviation(const SweepCase& c, const nlohmann::json& expected, const LevelOf& level_of) {
    double worst = 0;
    for (std::size_t k = 1; k < c.problem.layers; ++k) {
        const std::vector<Vec3> want = points(expected.at(k - 1));
        const auto level = level_of(k);
        for (std::size_t j = 0; j < want.size(); ++j) {
            worst = std::max(worst, (level[c.inner[j]] - want[j]).norm());
        }
    }
    return worst;
}

}  // namespace pavior::test

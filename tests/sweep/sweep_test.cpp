#include "support/catch.hpp"
#include "support/sweep_cases.hpp"

#include <pavior/sweep/sweep.hpp>

#include <cstring>
#include <filesystem>
#include <map>

using namespace pavior;
using namespace pavior::test;

namespace {

const std::map<std::string, AffineMethod> method_names{
    {"F", AffineMethod::f}, {"G", AffineMethod::g}, {"H31", AffineMethod::h}, {"HC", AffineMethod::constrained}};

SweepOptions options_of(const std::string& strategy, const std::string& name) {
    SweepOptions options;
    options.strategy = strategy == "front" ? SweepStrategy::front : SweepStrategy::direct;
    const bool corrected = name.ends_with("_bec");
    options.correction = corrected ? BoundaryCorrection::idw : BoundaryCorrection::none;
    options.method = method_names.at(corrected ? name.substr(0, name.size() - 4) : name);
    return options;
}

}  // namespace

TEST_CASE("every case, strategy, method and correction gives the expected nodes") {
    for (const std::string& name : sweep_case_names()) {
        const SweepCase c = read_sweep_case(name);
        for (const auto& [strategy, methods] : c.json.at("expected").items()) {
            for (const auto& [method, levels] : methods.items()) {
                INFO(name << " " << strategy << " " << method);
                const SweepResult result = sweep(c.problem, options_of(strategy, method));
                const double error = deviation(c, levels, [&](std::size_t k) { return result.mesh.level(k); });
                CHECK(error <= c.tolerance);
            }
        }
    }
}

TEST_CASE("every bad problem is refused with the right code") {
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(PAVIOR_TEST_DATA) / "sweep-bad")) {
        const nlohmann::json json = read_json(entry.path());
        INFO(entry.path().filename().string());
        std::string answer = "ok";
        try {
            const SweepResult result = sweep(problem_of(json));
            for (const Vec3& x : result.mesh.nodes()) {
                REQUIRE(x.allFinite());
            }
        } catch (const InputError& error) {
            answer = to_string(error.code());
        }
        CHECK(answer == json.at("want").get<std::string>());
    }
}

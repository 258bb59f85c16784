#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/sweep_cases.hpp"
#include "support/swept_grid.hpp"

#include <pavior/mesh/eigen_access.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/sweep.hpp>

#include <algorithm>
#include <cmath>

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

TEST_CASE("where the answer is known in closed form, it comes out") {
    for (const std::string& name : sweep_case_names()) {
        const SweepCase c = read_sweep_case(name);
        if (!c.json.contains("analytic")) {
            continue;
        }
        for (const auto strategy : {SweepStrategy::direct, SweepStrategy::front}) {
            for (const auto correction :
                 {BoundaryCorrection::none, BoundaryCorrection::idw, BoundaryCorrection::harmonic}) {
                SweepOptions options;
                options.strategy = strategy;
                options.correction = correction;
                const SweepResult result = sweep(c.problem, options);
                const auto level = [&](std::size_t k) { return result.mesh.level(k); };
                INFO(name);
                CHECK(deviation(c, c.json.at("analytic"), level) <= c.tolerance);
            }
        }
    }
}

TEST_CASE("CAD noise: the constrained map stays within the noise, Algorithm 3.1 does not") {
    const SweepCase c = read_sweep_case("h20_cad_noise");
    const auto error = [&](AffineMethod method) {
        SweepOptions options;
        options.method = method;
        const SweepResult result = sweep(c.problem, options);
        return deviation(c, c.json.at("noise_free"), [&](std::size_t k) { return result.mesh.level(k); });
    };
    CHECK(error(AffineMethod::constrained) <= c.json.at("noise_bound").get<double>());
    CHECK(error(AffineMethod::h) > 0.1);
}

// Section 3.5, advancing front without correction: f_shape, and the angle of the edges at the middle node.
TEST_CASE("the four tests of section 3.5") {
    struct Row {
        const char* name;
        AffineMethod method;
        double min, max, mean, deviation;
    };
    const Row rows[] = {{"s35_flattening", AffineMethod::f, .7143, .9997, .9745, .0400},
                        {"s35_flattening", AffineMethod::h, .8369, .9981, .9525, .0409},
                        {"s35_flipping", AffineMethod::f, .8203, .9998, .9821, .0239},
                        {"s35_flipping", AffineMethod::h, .9150, .9990, .9807, .0172},
                        {"s35_offset_scaling", AffineMethod::f, .3434, .9970, .8358, .1271},
                        {"s35_offset_scaling", AffineMethod::h, .8748, .9975, .9602, .0264},
                        {"s35_skewing", AffineMethod::g, .6123, .9840, .9151, .0626},
                        {"s35_skewing", AffineMethod::h, .8257, .9958, .9455, .0353}};
    for (const Row& row : rows) {
        INFO(row.name << " " << to_string(row.method));
        const SweepCase c = read_sweep_case(row.name);
        SweepOptions options;
        options.strategy = SweepStrategy::front;
        options.correction = BoundaryCorrection::none;
        options.method = row.method;
        const SweepResult result = sweep(c.problem, options);
        const HexQuality quality = hex_quality(result.mesh);
        CHECK(quality.f_shape.min == Approx(row.min).margin(5.1e-5));
        CHECK(quality.f_shape.max == Approx(row.max).margin(5.1e-5));
        CHECK(quality.f_shape.mean == Approx(row.mean).margin(5.1e-5));
        CHECK(quality.f_shape.stddev == Approx(row.deviation).margin(5.1e-5));
        CHECK(quality.inverted == 0);
        if (row.method == AffineMethod::h) {
            options.method = AffineMethod::constrained;
            const SweepResult constrained = sweep(c.problem, options);
            double gap = 0;
            for (std::size_t i = 0; i < result.mesh.nodes().size(); ++i) {
                gap = std::max(gap, (result.mesh.nodes()[i] - constrained.mesh.nodes()[i]).norm());
            }
            CHECK(gap < 1e-13);
        }
        const auto middle = c.json.at("middle").get<std::vector<std::size_t>>();
        const auto& stats = c.json.at("stats35").at(row.method == AffineMethod::h   ? "front/H31"
                                                    : row.method == AffineMethod::f ? "front/F"
                                                                                    : "front/G");
        for (std::size_t k = 1; k < c.problem.layers && row.method != AffineMethod::g; ++k) {
            const Vec3 a = result.mesh.level(k)[middle[0]] - result.mesh.level(k)[middle[1]];
            const Vec3 b = result.mesh.level(k)[middle[2]] - result.mesh.level(k)[middle[1]];
            const double angle = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::acos(-1.0);
            const double want = stats.at("angle_mid").at(k).get<double>();
            CHECK(std::min(std::abs(angle - want), std::abs(360 - angle - want)) < 1e-4);
        }
    }
}

TEST_CASE("every bad problem is refused with the right code") {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(PAVIOR_TEST_DATA) / "sweep-bad")) {
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

TEST_CASE("coordinates of 1e200 are swept right") {
    const nlohmann::json json =
        read_json(std::filesystem::path(PAVIOR_TEST_DATA) / "sweep-bad" / "b22_huge_1e200.json");
    SweepOptions options;
    options.correction = BoundaryCorrection::none;
    const SweepProblem problem = problem_of(json);
    const SweepResult result = sweep(problem, options);
    const auto& expected = json.at("expected").at("direct").at("HC");
    for (std::size_t k = 0; k <= problem.layers; ++k) {
        const std::vector<Vec3> want = points(expected.at(k));
        REQUIRE(want.size() == problem.level_size());
        for (std::size_t j = 0; j < want.size(); ++j) {
            CHECK(((result.mesh.level(k)[j] - want[j]) / 1e200).norm() < 1e-9);
        }
    }
}

TEST_CASE("foreign meshes give the same bytes as arrays") {
    // Float coordinates, so that the archetype can hold them.
    SweepProblem problem =
        moved(grid_problem(warped()), [](const Vec3& x) { return Vec3(x.cast<float>().cast<double>()); });
    const std::size_t n = problem.level_size();
    const SweepResult raw = sweep(problem);
    const LevelArray<> levels{problem.boundary_levels, problem.loops.nodes.size()};
    const auto same = [&](const SweepResult& other) {
        return std::memcmp(raw.mesh.nodes().data(), other.mesh.nodes().data(), raw.mesh.nodes().size_bytes()) == 0 &&
               raw.mesh.hex_count() == other.mesh.hex_count() && raw.mesh.hex(5) == other.mesh.hex(5);
    };
    Eigen::Matrix<double, Eigen::Dynamic, 3> V(n, 3);
    Eigen::MatrixXd T(n, 3);
    Eigen::MatrixXi F(problem.quads.size(), 4);
    for (std::size_t i = 0; i < n; ++i) {
        V.row(static_cast<Eigen::Index>(i)) = problem.source_nodes[i].transpose();
        T.row(static_cast<Eigen::Index>(i)) = problem.target_nodes[i].transpose();
    }
    for (std::size_t q = 0; q < problem.quads.size(); ++q) {
        for (std::size_t c = 0; c < 4; ++c) {
            F(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(c)) = static_cast<int>(problem.quads[q][c]);
        }
    }
    CHECK(same(sweep(EigenQuadMesh(V, F), EigenQuadMesh(T, F), problem.loops, levels)));
    const QuadMesh source{problem.source_nodes, problem.quads};
    CHECK(same(sweep(archetype::Quads(source), problem.target_nodes, problem.loops, levels)));
}

TEST_CASE("a builder receives the mesh, nodes first") {
    const SweepProblem problem = grid_problem(warped());
    const SweepResult whole = sweep(problem);
    HexMeshBuilder builder;
    write(prepare_sweep(problem).layers, builder, {2});
    const HexMesh built = builder.take();
    CHECK(std::equal(built.nodes.begin(), built.nodes.end(), whole.mesh.nodes().begin(), whole.mesh.nodes().end()));
    REQUIRE(built.hexes.size() == whole.mesh.hex_count());
    for (std::size_t h = 0; h < built.hexes.size(); ++h) {
        CHECK(built.hexes[h] == whole.mesh.hex(h));
    }
}

TEST_CASE("given positions of the levels weigh the two caps") {
    // The caps differ in their bump only, so that the middle node shows the weights.
    const SweepProblem problem = grid_problem(straight(), {.layers = 3, .bump = 0.3});
    SweepOptions options;
    options.blending = {0, 0.1, 0.4, 1};
    const SweepResult result = sweep(problem, options);
    const Index middle = 24;
    for (std::size_t k = 0; k <= 3; ++k) {
        const double bump = result.mesh.level(k)[middle][2] - problem.level(k)[0][2];
        CHECK(bump == Approx(-0.3 + 0.6 * options.blending[k]).margin(1e-14));
    }
    options.blending = {0, 1};
    CHECK_THROWS_AS(sweep(problem, options), InputError);
}

TEST_CASE("the report") {
    std::vector<std::string> stages;
    SweepOptions options;
    options.progress = [&](std::string_view stage, double) {
        if (stages.empty() || stages.back() != stage) {
            stages.emplace_back(stage);
        }
    };
    const SweepResult result = sweep(grid_problem(warped(), {.cells = 6, .hole = 2, .layers = 5}), options);
    CHECK(stages == std::vector<std::string>{"verify", "fit", "prepare", "nodes"});
    CHECK(result.report.layers == 5);
    CHECK(result.report.loops == 2);
    CHECK(result.report.loop_nodes == 32);
    CHECK(result.report.hexahedra == 5 * 32);
    CHECK(result.report.nodes == 6 * 48);
    CHECK(result.report.warnings.empty());
    REQUIRE(result.report.residuals.size() == 4);
    for (const LevelResidual& residual : result.report.residuals) {
        CHECK(residual.max >= residual.rms);
        CHECK(residual.rms > 1e-3);
    }
    // The quads look away from the sweep: every hexahedron is inverted, and the report says so.
    SweepProblem backwards = grid_problem(straight(-2.0));
    CHECK(sweep(backwards).report.find(SweepNotice::against_front) != nullptr);
    // Two sheets side by side.
    SweepProblem sheets = grid_problem(straight());
    const SweepProblem other = moved(sheets, [](const Vec3& x) { return Vec3(x + Vec3(3, 0, 0)); });
    const auto n = static_cast<Index>(sheets.level_size());
    std::vector<std::vector<Vec3>> levels;
    Loops loops = sheets.loops;
    std::vector<Index> second = sheets.loops.nodes;
    for (Index& i : second) {
        i += n;
    }
    loops.add(second);
    for (std::size_t k = 0; k <= sheets.layers; ++k) {
        levels.emplace_back(sheets.level(k).begin(), sheets.level(k).end());
        levels.back().insert(levels.back().end(), other.level(k).begin(), other.level(k).end());
    }
    QuadMesh source{sheets.source_nodes, sheets.quads};
    source.nodes.insert(source.nodes.end(), other.source_nodes.begin(), other.source_nodes.end());
    for (QuadCorners quad : sheets.quads) {
        for (Index& i : quad) {
            i += n;
        }
        source.quads.push_back(quad);
    }
    std::vector<Vec3> target = sheets.target_nodes;
    target.insert(target.end(), other.target_nodes.begin(), other.target_nodes.end());
    const SweepResult both = sweep(source, target, loops, levels);
    REQUIRE(both.report.find(SweepNotice::many_sheets) != nullptr);
    CHECK(both.report.find(SweepNotice::many_sheets)->ids.size() == 2);
    CHECK(verify_hexes(both.mesh).ok());
}

TEST_CASE("meshes too large for 32 bits are refused before anything is computed") {
    SweepProblem problem = grid_problem(straight(), {.layers = 1});
    problem.layers = std::size_t{1} << 32;
    try {
        static_cast<void>(sweep(problem));
        FAIL("accepted");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::overflow);
    }
}

#include <pavior/part/mesh_file.hpp>

#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <set>
#include <stop_token>
#include <string>
#include <thread>

using namespace pavior;

namespace {

const std::string data = PAVIOR_EXAMPLE_DATA;

PartOptions with_size(double size) {
    PartOptions options;
    options.size = size;
    return options;
}

}  // namespace

TEST_CASE("A STEP file becomes hexahedra with groups, decisions and reports") {
    const PartMesh part = mesh_file(data + "/assembly/bolt_plate_washer.step", with_size(2));
    REQUIRE(part.valid());
    std::set<int> solids(part.data.hex_groups.begin(), part.data.hex_groups.end());
    CHECK(solids.size() == 3);
    for (const int solid : solids) {
        CHECK_FALSE(group_name(part.data, 3, solid).empty());
    }
    for (const int face : part.data.quad_groups) {
        REQUIRE_FALSE(group_name(part.data, 2, face).empty());
    }
    const NodeEntities& entities = part.entities;
    REQUIRE(entities.of_node.size() == part.check.nodes);
    CHECK(entities.distance < 1e-6);
    const GmshBrep model = GmshBrep::load(data + "/assembly/bolt_plate_washer.step");
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < entities.of_node.size(); ++i) {
        const NodeEntity& entity = entities.of_node[i];
        vertices += entity.dimension == 0 ? 1 : 0;
        if (entity.dimension < 3) {
            REQUIRE((entity_point(model, entity) - part.data.mesh.nodes[i]).norm() < 1e-6);
        }
    }
    CHECK(vertices == model.vertex_count());
    const MethodTry& taken = part.decisions[0].tries[*part.decisions[0].taken];
    const auto report = nlohmann::json::parse(taken.report);
    CHECK(report["mesh"]["hexahedra"] == part.check.hexahedra);
    CHECK(report["cad_volume"].get<double>() == Approx(part.check.verify.volume).epsilon(0.02));
    CHECK(taken.hexahedra == part.check.hexahedra);
}

TEST_CASE("Faces get finer edges by their tag") {
    PartOptions options = with_size(2);
    options.methods = {PartMethod::multi_sweep};
    const std::string file = data + "/mfcad/0-1-13-19.step";
    const std::size_t coarse = mesh_file(file, options).check.hexahedra;
    options.local.face[1] = 0.25;
    const PartMesh fine = mesh_file(file, options);
    REQUIRE(fine.valid());
    CHECK(fine.check.hexahedra > 2 * coarse);
}

TEST_CASE("Files that are no models are refused by name") {
    CHECK_THROWS_WITH(mesh_file(data + "/no_such.step"), Catch::Contains("no_such.step"));
    PartOptions bad = with_size(-1);
    CHECK_THROWS_AS(mesh_file(data + "/mfcad/2-6-19.step", bad), InputError);
}

TEST_CASE("A limit of time ends a try in its process, and the decision says so") {
    PartOptions options = with_size(0.5);
    options.methods = {PartMethod::block};
    options.seconds = 0.05;
    const PartMesh part = mesh_file(data + "/mfcad/10-11-11-11-11-23.step", options);
    CHECK_FALSE(part.complete());
    REQUIRE(part.decisions.size() == 1);
    CHECK(part.decisions[0].out_of_time);
    CHECK(part.decisions[0].tries[0].outcome == TryOutcome::timed_out);
}

TEST_CASE("A stop from another thread ends the call, foreign code and all") {
    std::stop_source source;
    PartOptions options = with_size(0.25);
    options.methods = {PartMethod::block};
    options.execution.stop = source.get_token();
    bool trying = false;
    options.progress = [&](std::string_view stage, double) {
        if (stage == "block" && !trying) {
            trying = true;
            std::thread([source]() mutable {
                std::this_thread::sleep_for(std::chrono::milliseconds(100));
                source.request_stop();
            }).detach();
        }
    };
    const GmshBrep model = GmshBrep::load(data + "/mfcad/10-11-11-11-11-23.step");
    const Stopwatch watch;
    CHECK_THROWS_AS(mesh_model(model, options), Stopped);
    CHECK(trying);
    CHECK(watch.total() < 10);  // the blocks of this part take minutes
}

TEST_CASE("Calls from two threads wait for each other and give the same bytes") {
    const std::string file = data + "/mfcad/2-6-19.step";
    const PartMesh alone = mesh_file(file, with_size(1));
    PartMesh one, two;
    std::thread first([&] { one = mesh_file(file, with_size(1)); });
    std::thread second([&] { two = mesh_file(file, with_size(1)); });
    first.join();
    second.join();
    CHECK(one.data.mesh.nodes == alone.data.mesh.nodes);
    CHECK(two.data.mesh.nodes == alone.data.mesh.nodes);
    CHECK(two.data.mesh.hexes == alone.data.mesh.hexes);
}

#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/part/part_mesh.hpp>

#include <limits>

using namespace pavior;

TEST_CASE("A part is complete when every group has a mesh, valid when all are") {
    PartMesh part;
    CHECK_FALSE(part.valid());  // of nothing there is no mesh
    part.decisions.resize(2);
    part.decisions[0].tries.resize(2);
    part.decisions[0].tries[1].outcome = TryOutcome::mesh;
    part.decisions[0].taken = 1;
    part.decisions[1].tries.resize(1);
    part.decisions[1].tries[0].method = PartMethod::sweep;
    part.decisions[1].tries[0].outcome = TryOutcome::invalid;
    part.decisions[1].tries[0].reason = "2 inverted hexahedra";
    CHECK_FALSE(part.complete());
    part.decisions[1].taken = 0;
    CHECK(part.complete());
    CHECK_FALSE(part.valid());
    CHECK(reason_of(part) == "sweep: 2 inverted hexahedra\n");
    part.decisions[1].tries[0].outcome = TryOutcome::mesh;
    CHECK(part.valid());
    CHECK(reason_of(part).empty());
}

TEST_CASE("Options out of range are refused") {
    const auto refused = [](const PartOptions& options) {
        try {
            check_options(options);
            return false;
        } catch (const InputError& error) {
            return error.code() == ErrorCode::bad_option;
        }
    };
    PartOptions good;
    good.size = 0.5;
    good.max_hexahedra = 1e6;
    good.call_seconds = 0.1;
    CHECK_NOTHROW(check_options(good));
    PartOptions options = good;
    options.size = -1;
    CHECK(refused(options));
    options = good;
    options.size = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(options));
    options = good;
    options.seconds = -0.1;
    CHECK(refused(options));
    options = good;
    options.call_seconds = -0.1;
    CHECK(refused(options));
    options = good;
    options.max_hexahedra = -1;
    CHECK(refused(options));
}

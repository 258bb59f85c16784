#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/part/block_model.hpp>
#include <pavior/part/block_reference.hpp>

#include <string>

using namespace pavior;

namespace {

const std::string file = std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/2-6-19.step";

}  // namespace

TEST_CASE("A solid of a model is blocked with the tetrahedra that the kernel makes of it") {
    const GmshBrep model = GmshBrep::load(file);
    BlockOptions options;
    options.refine.emplace();
    options.refine->size = 1;
    std::size_t asked = 0;
    const BlockedModel made =
        block_model(model, SolidId{0}, options, [&](SolidId solid, double size, const FeatureOptions& features) {
            ++asked;
            CHECK(solid == SolidId{0});
            CHECK(size == 1);
            return read_block_reference(file, {.size = size, .features = features});
        });
    CHECK(asked == 1);
    CHECK(made.blocks.report.dual.valid());
    REQUIRE(made.blocks.fine.has_value());
    CHECK(made.blocks.fine->mesh.hexes.size() > 100);
    CHECK_FALSE(made.reference.surface.face_tags.empty());
}

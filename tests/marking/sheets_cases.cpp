// Whole solids from their surfaces: the same blocks on the coarsest, a graded and a fine reference mesh, turned or not.

#include "support/catch.hpp"
#include "support/round_solids.hpp"
#include "support/tilted_solids.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/block/dualize.hpp>
#include <pavior/block/verify_blocks.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/dual/verify_dual.hpp>
#include <pavior/marking/faces.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

using namespace pavior;

namespace {

/// How many solids a property is tried on: PAVIOR_SOLIDS if that is set.
unsigned trials(unsigned usual) {
    const char* wanted = std::getenv("PAVIOR_SOLIDS");
    return wanted != nullptr ? static_cast<unsigned>(std::stoul(wanted)) : usual;
}

/// 0: the coarsest, 1: graded, 2: fine, about `tets` tetrahedra.
ReferenceMesh reference_of(const TaggedSurface& surface, int kind, double tets) {
    TetOptions options;
    options.time_limit = 60;
    if (kind > 0) {
        options.quality = kind == 1 ? 1.4 : 1.3;
        options.keep_surface = false;
    }
    if (kind == 2) {
        options.max_volume = test::signed_volume(surface.mesh) / tets;
    }
    return make_reference_mesh(tetrahedralize(surface, options).mesh);
}

TaggedSurface bare(TriMesh mesh) {
    TaggedSurface surface;
    surface.mesh = std::move(mesh);
    return surface;
}

TaggedSurface turned(TaggedSurface surface, unsigned seed) {
    test::Random random(seed);
    const Eigen::Matrix3d turn = test::random_rotation(random);
    const Vec3 shift(random(-3, 3), random(-3, 3), random(-3, 3));
    for (Vec3& x : surface.mesh.nodes) {
        x = turn * x + shift;
    }
    return surface;
}

TaggedSurface read_off(const std::string& name) {
    std::ifstream file(std::string(PAVIOR_TEST_DATA) + "/block/" + name + ".off");
    std::string word;
    std::size_t nodes = 0;
    std::size_t faces = 0;
    std::size_t edges = 0;
    REQUIRE(file >> word >> nodes >> faces >> edges);
    TriMesh mesh;
    for (std::size_t i = 0; i < nodes; ++i) {
        Vec3 x;
        REQUIRE(file >> x[0] >> x[1] >> x[2]);
        mesh.nodes.push_back(x);
    }
    for (std::size_t i = 0; i < faces; ++i) {
        TriCorners t{};
        std::size_t count = 0;
        REQUIRE(file >> count >> t[0] >> t[1] >> t[2]);
        REQUIRE(count == 3);
        mesh.triangles.push_back(t);
    }
    if (test::signed_volume(mesh) < 0) {
        for (TriCorners& t : mesh.triangles) {
            std::swap(t[1], t[2]);
        }
    }
    return bare(std::move(mesh));
}

/// Blocks of a reference mesh, refined by two intervals an edge or to a size; everything verified.
void check_blocks(const ReferenceMesh& mesh, const test::BlockCount& want, double size = 0,
                  Propagation propagation = Propagation::full) {
    BlockOptions options;
    options.marking.propagation = propagation;
    options.refine.emplace();
    options.refine->size = size;
    const SolidBlocks solid = block_solid(mesh, options);
    CHECK(solid.report.status == BlockStatus::valid);
    CHECK(solid.report.marking.valid);
    CHECK(solid.report.marking.blocks == want.blocks);
    CHECK(solid.report.marking.nodes == want.nodes);
    CHECK(solid.blocks.hexes.size() == want.blocks);
    CHECK(solid.blocks.nodes.size() == want.nodes);
    CHECK(verify_blocks(solid.blocks, solid.placement.positions).conforming());
    REQUIRE(solid.fine);
    CHECK(verify_hexes(solid.fine->mesh).ok());
    CHECK(solid.fine->untangling.inverted_after == 0);
}

struct NamedCase {
    const char* name;
    test::BlockCount full;
    test::BlockCount stop;
};
constexpr std::array<NamedCase, 12> named_cases{{{"c01_brick_tapered", {8, 27}, {8, 27}},
                                                 {"c02_L_rounded", {22, 57}, {22, 57}},
                                                 {"c03_triangular_protrusions", {132, 259}, {132, 259}},
                                                 {"c04_half_gear", {336, 633}, {336, 633}},
                                                 {"c05_plate_two_holes", {96, 201}, {96, 201}},
                                                 {"c06_closed_loop", {112, 240}, {112, 240}},
                                                 {"c07_pyramid4", {92, 177}, {84, 165}},
                                                 {"c10_three_protrusions", {240, 397}, {240, 397}},
                                                 {"c13_cavity", {208, 342}, {208, 342}},
                                                 {"c15_tilted_T", {32, 81}, {32, 81}},
                                                 {"c17_notch_reversal", {32, 81}, {32, 81}},
                                                 {"c20_cylinder", {24, 51}, {24, 51}}}};

using test::circle;
using test::rings;
using test::square;

struct Solid {
    const char* name;
    TriMesh surface;
    test::BlockCount want;
};

}  // namespace

TEST_CASE("the solids of the collection have their blocks on every reference mesh, turned or not") {
    for (const NamedCase& c : named_cases) {
        const TaggedSurface surface = read_off(c.name);
        for (const unsigned seed : {0U, 7U}) {
            for (int kind = 0; kind < 3; ++kind) {
                INFO(c.name << ", turned by seed " << seed << ", reference mesh " << kind);
                check_blocks(reference_of(seed == 0 ? surface : turned(surface, seed), kind, 1000), c.full);
            }
        }
    }
}

TEST_CASE("stopped sheets: the solids of the collection, and never more blocks") {
    for (const NamedCase& c : named_cases) {
        INFO(c.name);
        check_blocks(reference_of(turned(read_off(c.name), 3), 0, 1000), c.stop, 0, Propagation::stop);
    }
}

TEST_CASE("round solids have their blocks on every reference mesh") {
    const std::vector<Solid> solids{
        {"cylinder", rings({circle(24, 1, 0), circle(24, 1, 2)}, false), {24, 51}},
        {"tube", rings({circle(24, 1, 0), circle(24, 1, 2), circle(24, 0.5, 2), circle(24, 0.5, 0)}, true), {32, 72}},
        {"sphere", test::sphere(24, 1), {32, 53}},
        {"shell", test::together(test::sphere(24, 1), test::sphere(24, 0.6, true)), {48, 78}},
        {"torus", test::bent_tube(24, 40, 2, 0.7, 360), {96, 136}},
        {"elbow", test::bent_tube(24, 10, 2, 0.7, 90), {24, 51}},
        {"boss",
         rings({square(24, 1.5, 0), square(24, 1.5, 1), circle(24, 0.6, 1), circle(24, 0.6, 2)}, false),
         {88, 157}},
        {"blind hole",
         rings({square(24, 1.5, 0), square(24, 1.5, 1.5), circle(24, 0.6, 1.5), circle(24, 0.6, 0.7)}, false),
         {104, 187}},
        {"counterbore",
         rings({square(24, 1.5, 0), square(24, 1.5, 1), circle(24, 0.8, 1), circle(24, 0.8, 0.6), circle(24, 0.4, 0.6),
                circle(24, 0.4, 0)},
               true),
         {112, 208}},
        {"shaft",
         rings({circle(24, 1, 0), circle(24, 1, 1), circle(24, 0.6, 1), circle(24, 0.6, 2.5)}, false),
         {80, 133}},
    };
    for (const Solid& solid : solids) {
        for (int kind = 0; kind < 3; ++kind) {
            INFO(solid.name << ", reference mesh " << kind);
            check_blocks(reference_of(turned(bare(solid.surface), 5), kind, 1000), solid.want, 0.25);
        }
    }
}

TEST_CASE("solids on the limits have their blocks on every reference mesh") {
    TriMesh spire = rings({square(24, 1.5, 0), square(24, 1.5, 1), circle(24, 1, 1)}, false);
    spire.nodes.back()[2] = 2;  // on a sphere with its base circle
    const std::vector<Solid> solids{
        {"prism with angles of 135 degrees", rings({circle(8, 1, 0), circle(8, 1, 2)}, false), {24, 51}},
        {"cone on a box", spire, {96, 173}},
        {"cylinder in a cylinder",
         test::together(rings({circle(24, 2, 0), circle(24, 2, 3)}, false),
                        rings({circle(24, 0.6, 1), circle(24, 0.6, 2)}, false, true)),
         {144, 222}},
        {"sphere in a box",
         test::together(rings({square(24, 1.5, -1.5), square(24, 1.5, 1.5)}, false), test::sphere(24, 0.8, true)),
         {80, 150}},
    };
    for (const Solid& solid : solids) {
        for (const unsigned seed : {0U, 7U}) {
            for (int kind = 0; kind < 3; ++kind) {
                INFO(solid.name << ", turned by seed " << seed << ", reference mesh " << kind);
                check_blocks(
                    reference_of(seed == 0 ? bare(solid.surface) : turned(bare(solid.surface), seed), kind, 1000),
                    solid.want, 0.25);
            }
        }
    }
}

TEST_CASE("random orthogonal solids have the blocks that are counted on their grid") {
    const unsigned count = trials(60);
    std::cout << "orthogonal solids: seeds 0 .. " << count - 1 << '\n';
    for (unsigned seed = 0; seed < count; ++seed) {
        test::Random random(seed);
        const test::VoxelSolid solid = test::random_voxels(random, 3 + static_cast<int>(seed % 3));
        const TaggedSurface surface = turned(bare(test::voxel_surface(solid).mesh), seed);
        for (int kind = 0; kind < 3; ++kind) {
            INFO("seed " << seed << ", reference mesh " << kind);
            check_blocks(reference_of(surface, kind, 300), test::count_blocks(solid));
        }
    }
}

TEST_CASE("random tilted solids have the blocks of the upright ones") {
    const unsigned count = trials(30);
    std::cout << "tilted solids: seeds 0 .. " << count - 1 << '\n';
    for (unsigned seed = 0; seed < count; ++seed) {
        test::Random random(seed);
        const double degrees = 5.0 * (1 + seed % 3);
        const test::CountedSolid solid =
            seed % 3 == 2 ? test::tilted_t(random, degrees) : test::tilted_voxels(random, 3, degrees);
        const TaggedSurface surface = turned(bare(solid.surface.mesh), seed);
        for (int kind = 0; kind < 3; ++kind) {
            INFO("seed " << seed << ", reference mesh " << kind);
            check_blocks(reference_of(surface, kind, 300), solid.want);
        }
    }
}

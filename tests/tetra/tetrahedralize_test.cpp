#include "support/catch.hpp"
#include "tet_checks.hpp"

#include <pavior/core/error.hpp>
#include <pavior/mesh/verify_tets.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>

using namespace pavior;

namespace {

void check_sound(const TaggedTetMesh& mesh, const TaggedSurface& surface) {
    CHECK(tets::fault(mesh) == "");
    CHECK(verify_tets(mesh.mesh).ok());
    CHECK(tets::flattest(mesh.mesh) > 1e-6);
    const double volume = tets::volume(surface.mesh);
    CHECK(std::abs(tets::volume(mesh.mesh) - volume) <= 1e-10 * std::abs(volume));
    REQUIRE(mesh.mesh.nodes.size() >= surface.mesh.nodes.size());
    CHECK(std::equal(surface.mesh.nodes.begin(), surface.mesh.nodes.end(), mesh.mesh.nodes.begin()));
    CHECK(mesh.vertices == surface.vertices);
}

void check_tags_inherited(const TaggedTetMesh& mesh, const TaggedSurface& surface) {
    const auto compare = [](const std::map<int, double>& made, const std::map<int, double>& given) {
        REQUIRE(made.size() == given.size());
        for (const auto& [tag, size] : given) {
            REQUIRE(made.contains(tag));
            CHECK(made.at(tag) == Approx(size).epsilon(1e-9));
        }
    };
    compare(tets::areas(mesh.mesh.nodes, tets::triangle_set(mesh)),
            tets::areas(surface.mesh.nodes, tets::triangle_set(surface)));
    compare(tets::lengths(mesh.mesh.nodes, mesh.edges), tets::lengths(surface.mesh.nodes, surface.edges));
}

/// Code of the InputError that \p body throws, and what it says.
template <class Body>
std::pair<ErrorCode, Error::Ids> refusal(Body&& body) {
    try {
        body();
    } catch (const InputError& error) {
        UNSCOPED_INFO(error.what());
        return {error.code(), error.ids()};
    }
    FAIL("no error");
    return {};
}

}  // namespace

TEST_CASE("The coarsest mesh keeps every triangle of the surface") {
    for (const std::string& name : tets::names()) {
        for (const int turn : {0, 1, 2}) {
            CAPTURE(name, turn);
            const TaggedSurface surface = tets::turned(tets::load(name + ".off"), turn);
            const TaggedTetMesh mesh = tetrahedralize(surface);
            check_sound(mesh, surface);
            CHECK(tets::triangle_set(mesh) == tets::triangle_set(surface));
        }
    }
}

TEST_CASE("A convex box needs no added node") {
    const TaggedTetMesh mesh = tetrahedralize(tets::box());
    CHECK(mesh.mesh.nodes.size() == 8);
    CHECK(mesh.mesh.tets.size() <= 6);
    CHECK((mesh.edges == tets::box().edges));
    REQUIRE(mesh.triangles.size() == 12);
    for (std::size_t t = 0; t < 12; ++t) {
        CHECK(tets::from_smallest(mesh.triangles[t].nodes) == tets::from_smallest(tets::box().mesh.triangles[t]));
        CHECK(mesh.triangles[t].tag == tets::box().face_tags[t]);
    }
    CHECK(mesh.vertices == tets::box().vertices);
}

TEST_CASE("Graded meshes split the surface, tags are inherited") {
    struct Setup {
        double quality;
        double divisor;  // of the volume; 0: no limit
    };
    for (const std::string& name : tets::names()) {
        for (const auto& [quality, divisor] : {Setup{0, 0}, Setup{1.4, 0}, Setup{1.3, 2000}}) {
            CAPTURE(name, quality, divisor);
            const TaggedSurface surface = tets::turned(tets::load(name + ".off"), divisor > 0 ? 1 : 0);
            TetOptions options;
            options.keep_surface = false;
            options.quality = quality;
            options.max_volume = divisor > 0 ? tets::volume(surface.mesh) / divisor : 0.0;
            const TaggedTetMesh mesh = tetrahedralize(surface, options);
            check_sound(mesh, surface);
            if (divisor > 0) {
                CHECK(mesh.mesh.tets.size() > static_cast<std::size_t>(divisor));
            }
        }
    }
}

TEST_CASE("Split edges and triangles of a tagged box have the tags of what they are parts of") {
    TaggedSurface surface = tets::box(Vec3(0, 0, 0), Vec3(3, 2, 1));
    surface.edges.push_back({{0, 6}, 99});  // a curve across a plane face
    for (const int turn : {0, 1}) {
        TetOptions options;
        options.keep_surface = false;
        options.quality = 1.3;
        options.max_volume = 0.01;
        const TaggedSurface there = tets::turned(surface, turn);
        const TaggedTetMesh mesh = tetrahedralize(there, options);
        check_sound(mesh, there);
        check_tags_inherited(mesh, there);
        CHECK(mesh.triangles.size() > 100);
        CHECK(mesh.edges.size() > 50);
        for (const TetCorners& c : mesh.mesh.tets) {
            const Vec3& x = mesh.mesh.nodes[c[0]];
            const double six =
                (mesh.mesh.nodes[c[1]] - x).cross(mesh.mesh.nodes[c[2]] - x).dot(mesh.mesh.nodes[c[3]] - x);
            REQUIRE(six / 6.0 <= 0.0101);
        }
    }
}

TEST_CASE("Quality refines the inside alone where the surface is kept") {
    const TaggedSurface surface = tets::load("c20_cylinder.off");
    TetOptions options;
    options.quality = 1.3;
    const TaggedTetMesh mesh = tetrahedralize(surface, options);
    check_sound(mesh, surface);
    CHECK(tets::triangle_set(mesh) == tets::triangle_set(surface));
    CHECK(mesh.mesh.nodes.size() > tetrahedralize(surface).mesh.nodes.size() + 20);
}

TEST_CASE("Cavities, solids in cavities and separate solids") {
    const TaggedSurface outer = tets::box(Vec3::Constant(-4), Vec3::Constant(4));
    const TaggedSurface hole = tets::box(Vec3::Constant(-3), Vec3::Constant(3));
    const TaggedSurface core = tets::box(Vec3::Constant(-1), Vec3::Constant(1));
    const TaggedSurface beside = tets::box(Vec3(9, 0, 0), Vec3(10, 1, 1));
    const TaggedSurface all = tets::joined(tets::joined(tets::joined(outer, hole, true), core), beside);
    for (const int turn : {0, 1}) {
        for (const bool keep : {true, false}) {
            const TaggedSurface surface = tets::turned(all, turn);
            TetOptions options;
            options.keep_surface = keep;
            const TaggedTetMesh mesh = tetrahedralize(surface, options);
            check_sound(mesh, surface);
            CHECK(tets::volume(mesh.mesh) == Approx(512.0 - 216.0 + 8.0 + 1.0));
            check_tags_inherited(mesh, surface);
        }
    }
}

TEST_CASE("A thin cavity close to the boundary is emptied") {
    const TaggedSurface outer = tets::box();
    const TaggedSurface gap = tets::box(Vec3(0.1, 0.1, 0.4999), Vec3(0.9, 0.9, 0.5));
    const TaggedSurface surface = tets::turned(tets::joined(outer, gap, true), 1);
    const TaggedTetMesh mesh = tetrahedralize(surface);
    CHECK(tets::fault(mesh) == "");
    CHECK(tets::volume(mesh.mesh) == Approx(1.0 - 0.64e-4).epsilon(1e-12));
}

TEST_CASE("Inner facets have tetrahedra on both sides, keep their tag and sense") {
    TaggedSurface surface = tets::box();
    // The middle plane x = 1/2, on nodes inside: an island that touches no side.
    const auto first = static_cast<Index>(surface.mesh.nodes.size());
    for (const auto& [y, z] : {std::pair{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}}) {
        surface.mesh.nodes.emplace_back(0.5, y, z);
    }
    std::vector<TaggedTriangle> inner{{{first, first + 1, first + 2}, 50}, {{first, first + 2, first + 3}, 51}};
    // A wall that ends at the boundary: the diagonal plane through four corners.
    const std::vector<TaggedTriangle> wall{{{0, 5, 7}, 60}, {{0, 7, 2}, 61}};
    for (const auto& facets : {inner, wall}) {
        if (facets == wall) {
            surface.mesh.nodes.resize(8);
        }
        const TaggedTetMesh mesh = tetrahedralize(surface, facets);
        check_sound(mesh, surface);
        REQUIRE(mesh.triangles.size() == 14);
        CHECK(mesh.triangles[12].tag == facets[0].tag);
        CHECK(mesh.triangles[13].tag == facets[1].tag);
        const auto set = tets::triangle_set(mesh);
        for (const TaggedTriangle& facet : facets) {
            CHECK(set.contains({tets::from_smallest(facet.nodes), facet.tag}));
        }
        TetOptions fine;
        fine.keep_surface = false;
        fine.max_volume = 0.01;
        const TaggedTetMesh split = tetrahedralize(surface, facets, fine);
        check_sound(split, surface);
        const auto area = tets::areas(split.mesh.nodes, tets::triangle_set(split));
        for (const TaggedTriangle& facet : facets) {
            CHECK(area.at(facet.tag) == Approx(facets == wall ? std::sqrt(0.5) : 0.08));
        }
    }
}

TEST_CASE("Inner facets that cannot be") {
    const TaggedSurface surface = tets::box();
    const auto with = [&](const std::vector<Vec3>& nodes, const TriCorners& c) {
        TaggedSurface more = surface;
        more.mesh.nodes.insert(more.mesh.nodes.end(), nodes.begin(), nodes.end());
        const std::vector<TaggedTriangle> inner{{c, 0}};
        return refusal([&] { return tetrahedralize(more, inner); });
    };
    CHECK(with({{2, 0, 0}, {3, 0, 0}, {2, 1, 0}}, {8, 9, 10}).first == ErrorCode::inconsistent_boundary);
    CHECK(with({{0.5, 0.5, 0.5}, {3, 0.5, 0.5}, {0.5, 0.6, 0.5}}, {8, 9, 10}).first == ErrorCode::self_intersection);
    CHECK(with({}, {0, 4, 6}).first == ErrorCode::non_manifold);
    CHECK(with({}, {0, 4, 8}).first == ErrorCode::bad_index);
}

TEST_CASE("Tags that do not fit are refused") {
    TaggedSurface surface = tets::box();
    surface.edges.push_back({{0, 7}, 5});
    CHECK(refusal([&] { return tetrahedralize(surface); }) == std::pair{ErrorCode::bad_index, Error::Ids{12}});
    surface = tets::box();
    surface.vertices.push_back({8, 1});
    CHECK(refusal([&] { return tetrahedralize(surface); }) == std::pair{ErrorCode::bad_index, Error::Ids{8}});
    surface = tets::box();
    surface.face_tags.pop_back();
    CHECK(refusal([&] { return tetrahedralize(surface); }).first == ErrorCode::size_mismatch);
}

TEST_CASE("Options out of range are refused") {
    const auto code = [](auto&& change) {
        TetOptions options;
        change(options);
        return refusal([&] { return tetrahedralize(tets::box(), options); }).first;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(code([](TetOptions& o) { o.quality = 0.5; }) == ErrorCode::bad_option);
    CHECK(code([](TetOptions& o) { o.quality = -1; }) == ErrorCode::bad_option);
    CHECK(code([&](TetOptions& o) { o.quality = nan; }) == ErrorCode::bad_option);
    CHECK(code([](TetOptions& o) { o.max_volume = -1; }) == ErrorCode::bad_option);
    CHECK(code([&](TetOptions& o) { o.max_volume = nan; }) == ErrorCode::bad_option);
    CHECK(code([](TetOptions& o) { o.time_limit = -1; }) == ErrorCode::bad_option);
}

TEST_CASE("Coordinates of any magnitude") {
    const TaggedSurface cavity = tets::load("c13_cavity.off");
    const auto count = tetrahedralize(cavity).mesh.tets.size();
    for (const double scale : {1e-9, 1e-150, 1e9, 1e150}) {
        TaggedSurface surface = cavity;
        for (Vec3& x : surface.mesh.nodes) {
            x *= scale;
        }
        CAPTURE(scale);
        const TaggedTetMesh mesh = tetrahedralize(surface);
        CHECK(tets::fault(mesh) == "");
        CHECK(tets::triangle_set(mesh) == tets::triangle_set(surface));
        CHECK(mesh.mesh.tets.size() >= count);
        if (scale == 1e-9 || scale == 1e9) {
            check_sound(mesh, surface);
            TetOptions options;
            options.keep_surface = false;
            options.max_volume = 0.2 * scale * scale * scale;
            check_sound(tetrahedralize(surface, options), surface);
        }
    }
}

TEST_CASE("A unit solid a billion units away") {
    TaggedSurface surface = tets::box(Vec3::Constant(1e9), Vec3::Constant(1e9 + 1));
    TetOptions options;
    options.max_volume = 0.01;
    options.keep_surface = false;
    const TaggedTetMesh mesh = tetrahedralize(surface, options);
    CHECK(tets::fault(mesh) == "");
    CHECK(tets::flattest(mesh.mesh) > 1e-3);
    // Here the size drowns in the distance: one place for all nodes.
    const TaggedSurface lost = tets::box(Vec3::Constant(1e9), Vec3::Constant(1e9 + 1e-9));
    CHECK(refusal([&] { return tetrahedralize(lost); }).first == ErrorCode::degenerate_triangle);
}

TEST_CASE("Bad surfaces are refused by name, and the process goes on") {
    const TaggedSurface good = tets::box();
    const auto broken = [&](auto&& change) {
        TaggedSurface surface = good;
        surface.edges.clear();
        surface.vertices.clear();
        surface.face_tags.clear();
        change(surface.mesh);
        return refusal([&] { return tetrahedralize(surface); });
    };
    CHECK(broken([](TriMesh& m) { m.triangles.clear(); }).first == ErrorCode::empty_input);
    CHECK(broken([](TriMesh& m) { m.nodes[3].x() = std::numeric_limits<double>::quiet_NaN(); }) ==
          std::pair{ErrorCode::not_finite, Error::Ids{2, 7, 8, 9}});
    CHECK(broken([](TriMesh& m) { m.triangles[4][1] = 77; }) == std::pair{ErrorCode::bad_index, Error::Ids{4}});
    CHECK(broken([](TriMesh& m) { m.triangles.pop_back(); }) ==
          std::pair{ErrorCode::open_surface, Error::Ids{0, 6, 10}});
    CHECK(broken([](TriMesh& m) { std::swap(m.triangles[5][1], m.triangles[5][2]); }).first ==
          ErrorCode::bad_orientation);
    CHECK(broken([](TriMesh& m) { m.triangles.push_back(m.triangles[2]); }).first == ErrorCode::non_manifold);
    CHECK(broken([](TriMesh& m) { m.nodes[7] = {-2, 0.4, 0.4}; }).first == ErrorCode::self_intersection);
}

TEST_CASE("Runs are deterministic, also in several threads at once") {
    TetOptions options;
    options.keep_surface = false;
    options.quality = 1.4;
    const TaggedSurface surface = tets::turned(tets::load("c10_three_protrusions.off"), 1);
    const TaggedTetMesh expected = tetrahedralize(surface, options);
    std::vector<TaggedTetMesh> made(4);
    std::vector<std::thread> threads;
    for (TaggedTetMesh& mesh : made) {
        threads.emplace_back([&] { mesh = tetrahedralize(surface, options); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const TaggedTetMesh& mesh : made) {
        CHECK((mesh.mesh.nodes == expected.mesh.nodes && mesh.mesh.tets == expected.mesh.tets));
        CHECK((mesh.triangles == expected.triangles && mesh.edges == expected.edges));
    }
}

TEST_CASE("A run that takes too long ends in an error") {
    const TaggedSurface surface = tets::box();
    TetOptions options;
    options.max_volume = 1e-7;
    options.keep_surface = false;
    options.time_limit = 0.2;
    const auto start = std::chrono::steady_clock::now();
    CHECK(refusal([&] { return tetrahedralize(surface, options); }).first == ErrorCode::tetrahedra_failed);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
    options.max_volume = 1e-12;
    CHECK(refusal([&] { return tetrahedralize(surface, options); }).first == ErrorCode::bad_option);
}

TEST_CASE("CGAL samples the surface anew, and keeps tags") {
    TetOptions options;
    options.engine = TetEngine::cgal;
    CHECK(refusal([&] { return tetrahedralize(tets::box(), options); }).first == ErrorCode::bad_option);
    options.keep_surface = false;
    const std::vector<TaggedTriangle> wall{{{0, 5, 7}, 60}, {{0, 7, 2}, 61}};
    CHECK(refusal([&] { return tetrahedralize(tets::box(), wall, options); }).first == ErrorCode::bad_option);
    options.quality = 2.5;
    options.max_volume = 0.01;
    const TaggedSurface cube = tets::joined(tets::box(Vec3::Zero(), Vec3::Constant(2)),
                                            tets::box(Vec3::Constant(0.5), Vec3::Constant(1.5)), true);
    for (const int turn : {0, 1}) {
        const TaggedSurface surface = tets::turned(cube, turn);
        const TaggedTetMesh mesh = tetrahedralize(surface, options);
        CHECK(tets::fault(mesh) == "");
        CHECK(tets::flattest(mesh.mesh) > 1e-4);
        CHECK(tets::volume(mesh.mesh) == Approx(7.0).epsilon(1e-9));
        check_tags_inherited(mesh, surface);
        REQUIRE(mesh.vertices.size() == 16);
        for (std::size_t i = 0; i < 16; ++i) {
            CHECK(mesh.vertices[i].tag == surface.vertices[i].tag);
            CHECK(mesh.mesh.nodes[mesh.vertices[i].node] == surface.mesh.nodes[i]);
        }
        CHECK(mesh.mesh.tets.size() > 400);
        const TaggedTetMesh again = tetrahedralize(surface, options);
        CHECK((again.mesh.nodes == mesh.mesh.nodes && again.mesh.tets == mesh.mesh.tets));
    }
}

TEST_CASE("CGAL fills the domains that TetGen fills") {
    for (const std::string name : {"c01_brick_tapered", "c02_L_rounded", "c13_cavity", "c17_notch_reversal"}) {
        CAPTURE(name);
        TetOptions options;
        options.engine = TetEngine::cgal;
        options.keep_surface = false;
        const TaggedSurface surface = tets::load(name + ".off");
        const TaggedTetMesh mesh = tetrahedralize(surface, options);
        CHECK(tets::fault(mesh) == "");
        CHECK(tets::flattest(mesh.mesh) > 1e-6);
        CHECK(tets::volume(mesh.mesh) == Approx(tets::volume(surface.mesh)).epsilon(0.02));
    }
}

#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/features.hpp>

#include <algorithm>
#include <map>
#include <set>

using namespace pavior;
using tet_meshes::box;
using tet_meshes::tetrahedra;
using tet_meshes::voxels;

namespace {
std::size_t patch_count(const ReferenceMesh& mesh) {
    std::set<std::int32_t> ids;
    for (const TaggedTriangle& t : mesh.patches) {
        ids.insert(t.tag);
    }
    return ids.size();
}
std::map<std::int32_t, std::vector<FeatureEdge>> curves_of(const ReferenceMesh& mesh) {
    std::map<std::int32_t, std::vector<FeatureEdge>> curves;
    for (const FeatureEdge& e : mesh.curves) {
        curves[e.curve].push_back(e);
    }
    return curves;
}
std::size_t count(const ReferenceMesh& mesh, CurveKind kind) {
    std::set<std::int32_t> ids;
    for (const FeatureEdge& e : mesh.curves) {
        if (e.kind == kind) {
            ids.insert(e.curve);
        }
    }
    return ids.size();
}

Index node_at(const tet_meshes::VoxelTets& tets, Index i, Index j, Index k) {
    const tet_meshes::Lattice wanted{i, j, k};
    return static_cast<Index>(std::find(tets.lattice.begin(), tets.lattice.end(), wanted) - tets.lattice.begin());
}

// A prism over a regular polygon of n sides: a cylinder when n is large.
TetMesh prism(Index n) {
    TetMesh mesh;
    for (const double z : {0.0, 1.0}) {
        mesh.nodes.push_back(Vec3(0, 0, z));
        for (Index i = 0; i < n; ++i) {
            const double a = 2.0 * 3.14159265358979323846 * i / n;
            mesh.nodes.push_back(Vec3(std::cos(a), std::sin(a), z));
        }
    }
    for (Index i = 0; i < n; ++i) {
        const Index a = 1 + i;
        const Index b = 1 + (i + 1) % n;
        const Index top = n + 1;
        // Diagonals from the lower of the two nodes, so that neighbours conform.
        const Index low = std::min(a, b);
        const Index high = std::max(a, b);
        TetCorners first{0, low, high, top + high};
        TetCorners second{0, low, top + low, top + high};
        const TetCorners third{0, top, top + a, top + b};
        mesh.tets.push_back(first);
        mesh.tets.push_back(second);
        mesh.tets.push_back(third);
    }
    for (TetCorners& c : mesh.tets) {
        const Vec3 x = mesh.nodes[c[0]];
        if ((mesh.nodes[c[1]] - x).cross(mesh.nodes[c[2]] - x).dot(mesh.nodes[c[3]] - x) < 0.0) {
            std::swap(c[2], c[3]);
        }
    }
    return mesh;
}
}  // namespace

TEST_CASE("a box: six patches, twelve end curves, eight vertices of valence three") {
    const ReferenceMesh mesh = make_reference_mesh(tetrahedra(box(3, 2, 2)).mesh);
    CHECK(patch_count(mesh) == 6);
    CHECK(curves_of(mesh).size() == 12);
    CHECK(count(mesh, CurveKind::end) == 12);
    CHECK(mesh.vertices.size() == 8);
    CHECK(feature_valences(mesh) == std::vector<Index>(8, 3));
    CHECK(mesh.vertices.front().tag == -1);
    CHECK(mesh.layers.empty());
}

TEST_CASE("an L has one corner curve") {
    const auto l_shape = voxels({2, 2, 2}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const ReferenceMesh mesh = make_reference_mesh(tetrahedra(l_shape, 2).mesh);
    CHECK(patch_count(mesh) == 8);
    CHECK(count(mesh, CurveKind::corner) == 1);
    CHECK(count(mesh, CurveKind::end) == 17);
    CHECK(mesh.vertices.size() == 12);
    FeatureOptions options;
    options.corner_above = 280.0;
    CHECK(count(make_reference_mesh(tetrahedra(l_shape).mesh, options), CurveKind::corner) == 0);
    options.corner_above = 200.0;
    options.reversal_above = 260.0;
    CHECK(count(make_reference_mesh(tetrahedra(l_shape).mesh, options), CurveKind::reversal) == 1);
}

TEST_CASE("one tag on all feature edges leaves each curve its kind") {
    const auto l_shape = voxels({2, 2, 2}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const TetMesh tets = tetrahedra(l_shape, 2).mesh;
    const ReferenceMesh plain = make_reference_mesh(tets);
    TaggedTetMesh tagged{tets, {}, {}, {}};
    FeatureOptions options;
    options.sort_tets = false;
    for (const FeatureEdge& edge : make_reference_mesh(tets, options).curves) {
        tagged.edges.push_back({edge.nodes, 7});
    }
    const ReferenceMesh mesh = make_reference_mesh(tagged);
    CHECK(mesh.curves == plain.curves);
    CHECK(count(mesh, CurveKind::corner) == 1);
    CHECK(count(mesh, CurveKind::end) == 17);
}

TEST_CASE("several components of the boundary") {
    const auto shell = voxels({3, 3, 3}, [](Index i, Index j, Index k) { return i != 1 || j != 1 || k != 1; });
    const ReferenceMesh mesh = make_reference_mesh(tetrahedra(shell).mesh);
    CHECK(patch_count(mesh) == 12);
    CHECK(count(mesh, CurveKind::end) == 12);
    CHECK(count(mesh, CurveKind::corner) == 12);
    CHECK(mesh.vertices.size() == 16);
}

TEST_CASE("closed curves have no vertex") {
    const ReferenceMesh mesh = make_reference_mesh(prism(24));
    CHECK(patch_count(mesh) == 3);
    CHECK(curves_of(mesh).size() == 2);
    CHECK(mesh.vertices.empty());
    CHECK(make_reference_mesh(prism(6)).vertices.size() == 12);  // 120 degrees at the sides
}

TEST_CASE("kinks of two feature edges are no vertices") {
    // An edge of a cube declared smooth leaves two features at each of its ends, where they meet at a right angle.
    const auto tets = tetrahedra(box(1, 1, 1));
    const Index a = node_at(tets, 0, 0, 0);
    const Index b = node_at(tets, 1, 0, 0);
    const ReferenceMesh before = make_reference_mesh(tets.mesh);
    REQUIRE(std::any_of(before.curves.begin(), before.curves.end(), [&](const FeatureEdge& e) {
        return e.nodes == std::array<Index, 2>{std::min(a, b), std::max(a, b)};
    }));
    FeatureOptions options;
    options.overrides.push_back({{a, b}, 0, CurveKind::smooth});
    const ReferenceMesh after = make_reference_mesh(tets.mesh, options);
    CHECK(after.curves.size() == 11);
    CHECK(curves_of(after).size() == 9);  // the two features at an end are one curve
    CHECK(patch_count(after) == 5);
    CHECK(after.vertices.size() == 6);
    for (const TaggedNode& v : after.vertices) {
        CHECK(v.node != a);
        CHECK(v.node != b);
    }
}

TEST_CASE("a curve that ends inside a patch has a vertex there") {
    const auto tets = tetrahedra(box(1, 1, 1), 2);
    const Index middle = node_at(tets, 1, 1, 0);
    FeatureOptions options;
    options.overrides.push_back({{node_at(tets, 0, 1, 0), middle}, 0, CurveKind::end});
    const ReferenceMesh mesh = make_reference_mesh(tets.mesh, options);
    CHECK(mesh.vertices.size() == 10);
    CHECK(patch_count(mesh) == 6);
    const auto at =
        std::find_if(mesh.vertices.begin(), mesh.vertices.end(), [&](const TaggedNode& v) { return v.node == middle; });
    REQUIRE(at != mesh.vertices.end());
    CHECK(feature_valences(mesh)[static_cast<std::size_t>(at - mesh.vertices.begin())] == 1);
}

TEST_CASE("tags: patches, curves and vertices carry them; inner facets become layers") {
    const auto tets = tetrahedra(box(2, 1, 1));
    const TetTopology topology = tet_topology(tets.mesh);
    TaggedTetMesh tagged{tets.mesh, {}, {}, {}};
    for (Index f = 0; f < topology.faces.size(); ++f) {
        const auto& c = topology.faces[f];
        const auto all = [&](std::size_t axis, Index at) {
            return tets.lattice[c[0]][axis] == at && tets.lattice[c[1]][axis] == at && tets.lattice[c[2]][axis] == at;
        };
        if (all(2, 0)) {
            tagged.triangles.push_back(
                {c, 40 + static_cast<std::int32_t>(
                             tets.mesh.nodes[c[0]].x() + tets.mesh.nodes[c[1]].x() + tets.mesh.nodes[c[2]].x() > 3.0)});
        } else if (all(0, 1)) {
            tagged.triangles.push_back({c, 7});
        }
    }
    tagged.vertices = {{0, 5}};
    const ReferenceMesh mesh = make_reference_mesh(tagged);
    CHECK(mesh.layers.size() == 2);
    CHECK(mesh.patch_tags.size() == 2);  // one patch, two tags
    CHECK(mesh.patch_tags[0].id == mesh.patch_tags[1].id);
    CHECK(mesh.patch_tags[0].tag == 40);
    CHECK(mesh.patch_tags[1].tag == 41);
    const auto at =
        std::find_if(mesh.vertices.begin(), mesh.vertices.end(), [](const TaggedNode& v) { return v.node == 0; });
    REQUIRE(at != mesh.vertices.end());
    CHECK(at->tag == 5);
    FeatureOptions options;
    options.facets_are_layers = false;
    CHECK(make_reference_mesh(tagged, options).layers.empty());
    tagged.triangles.push_back({{0, 1, 99}, 0});
    CHECK_THROWS_AS(make_reference_mesh(tagged), InputError);
}

TEST_CASE("tagged edges: candidates, ignored, features; overrides by tag") {
    // A prism of 24 sides with its seam tagged 3 and its circles 1 and 2.
    const TetMesh tets = prism(24);
    TaggedTetMesh tagged{tets, {}, {}, {{1, 9}}};
    for (Index i = 0; i < 24; ++i) {
        tagged.edges.push_back({{1 + i, 1 + (i + 1) % 24}, 1});
        tagged.edges.push_back({{26 + i, 26 + (i + 1) % 24}, 2});
    }
    tagged.edges.push_back({{1, 26}, 3});
    FeatureOptions options;
    ReferenceMesh mesh = make_reference_mesh(tagged, options);
    CHECK(mesh.curves.size() == 48);
    CHECK(mesh.curve_tags.size() == 2);
    CHECK(mesh.vertices.empty());
    options.force_tagged_vertices = true;
    mesh = make_reference_mesh(tagged, options);
    CHECK(mesh.vertices == std::vector<TaggedNode>{{1, 9}});
    CHECK(curves_of(mesh).size() == 2);
    options = {};
    options.tagged_edges = TaggedEdges::features;
    mesh = make_reference_mesh(tagged, options);
    CHECK(mesh.curves.size() == 49);
    CHECK(mesh.vertices.size() == 2);
    options.overrides = {{{no_index, no_index}, 3, CurveKind::smooth}};
    CHECK(make_reference_mesh(tagged, options).vertices.empty());
    options.overrides = {{{no_index, no_index}, 3, CurveKind::reversal}};
    CHECK(count(make_reference_mesh(tagged, options), CurveKind::reversal) == 1);
    options.overrides = {{{no_index, no_index}, 4, CurveKind::end}};
    CHECK_THROWS_AS(make_reference_mesh(tagged, options), InputError);
    options = {};
    tagged.edges.resize(1);  // one edge of a circle is not enough for a curve, but it is all that is tagged
    CHECK(make_reference_mesh(tagged, options).curves.size() == 1);
    options.tagged_edges = TaggedEdges::ignored;
    CHECK(make_reference_mesh(tagged, options).curves.size() == 48);
    tagged.edges.push_back({{1, 20}, 1});
    CHECK_THROWS_AS(make_reference_mesh(tagged), InputError);
}

TEST_CASE("the result does not depend on the order of the tetrahedra, but for numbers") {
    const auto l_shape = voxels({2, 2, 2}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    TetMesh mesh = tetrahedra(l_shape, 2).mesh;
    const ReferenceMesh sorted = make_reference_mesh(mesh);
    FeatureOptions options;
    options.sort_tets = false;
    const ReferenceMesh kept = make_reference_mesh(mesh, options);
    CHECK(kept.tets == mesh.tets);
    CHECK(sorted.nodes == mesh.nodes);
    const auto nodes = [](const ReferenceMesh& m) {
        std::set<std::array<Index, 2>> all;
        for (const FeatureEdge& e : m.curves) {
            all.insert(e.nodes);
        }
        return all;
    };
    CHECK(nodes(sorted) == nodes(kept));
    CHECK(sorted.vertices == kept.vertices);
    const TetTopology topology = tet_topology(mesh);
    CHECK(make_reference_mesh(mesh, topology).curves == kept.curves);
    CHECK(make_reference_mesh(archetype::Tets(kept)).curves == sorted.curves);
}

TEST_CASE("bad options") {
    const TetMesh mesh = tetrahedra(box(1, 1, 1)).mesh;
    FeatureOptions options;
    options.end_below = 190.0;
    CHECK_THROWS_AS(make_reference_mesh(mesh, options), InputError);
    options = {};
    options.reversal_above = 200.0;
    CHECK_THROWS_AS(make_reference_mesh(mesh, options), InputError);
    options = {};
    options.overrides.push_back({{0, 99}, 0, CurveKind::end});
    CHECK_THROWS_AS(make_reference_mesh(mesh, options), InputError);
}

TEST_CASE("solids so large or small that products of lengths leave the range of doubles are refused") {
    const TetMesh mesh = tetrahedra(box(1, 1, 1)).mesh;
    for (const double scale : {1e-160, 1e-74, 1e-9, 1e9, 1e74, 1e160}) {
        TetMesh scaled = mesh;
        for (Vec3& x : scaled.nodes) {
            x *= scale;
        }
        if (scale < 1e-100 || scale > 1e100) {
            CHECK_THROWS_AS(make_reference_mesh(scaled), InputError);
        } else {
            CHECK(make_reference_mesh(scaled).curves == make_reference_mesh(mesh).curves);
        }
    }
}

TEST_CASE("an angle on a limit is on the far side of it whatever its round-off") {
    for (const double noise : {-1e-9, 0.0, 1e-9}) {
        CHECK(curve_kind(135 + noise) == CurveKind::smooth);
        CHECK(curve_kind(225 + noise) == CurveKind::corner);
        CHECK(curve_kind(315 + noise) == CurveKind::reversal);
    }
    CHECK(curve_kind(134.9999) == CurveKind::end);
    CHECK(curve_kind(224.9999) == CurveKind::smooth);
    CHECK(curve_kind(314.9999) == CurveKind::corner);
}

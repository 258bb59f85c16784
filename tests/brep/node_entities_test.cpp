#include <pavior/brep/node_entities.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/entity_checks.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/detail/entity_incidences.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr double pi = std::numbers::pi;

/// The solids of b swept between their faces 0 and 1, n intervals an edge.
ModelMesh swept(const TestBrep& b, int n) {
    std::vector<SweepTopology> sweeps;
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        const SolidId solid{static_cast<std::int32_t>(s)};
        sweeps.push_back(sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face));
    }
    return sweep_model(b, sweeps, std::vector<int>(b.edge_count(), n), GridCap<TestBrep>{&b});
}

/// A mesh of faces alone.
struct FacesOnly {
    HexMesh mesh;
    std::vector<SolidId> hex_solid;
    std::vector<QuadCorners> quads;
    std::vector<FaceId> quad_face;

    Index node(const Vec3& x) {
        mesh.nodes.push_back(x);
        return static_cast<Index>(mesh.nodes.size() - 1);
    }
    void quad(FaceId f, Index a, Index b, Index c, Index d) {
        quads.push_back({a, b, c, d});
        quad_face.push_back(f);
    }
};

std::vector<Index> ring(FacesOnly& faces, int n, double radius, double z, double turn = 0) {
    std::vector<Index> result;
    for (int i = 0; i < n; ++i) {
        const double angle = turn + 2 * pi * i / n;
        result.push_back(faces.node({radius * std::cos(angle), radius * std::sin(angle), z}));
    }
    return result;
}

/// What the concept asks for and no more; parameters come out periods away, and faces name their poles.
struct Foreign {
    const TestBrep* b;

    std::size_t vertex_count() const { return b->vertex_count(); }
    std::size_t edge_count() const { return b->edge_count(); }
    std::size_t face_count() const { return b->face_count(); }
    std::size_t solid_count() const { return b->solid_count(); }
    std::vector<OrientedFace> solid_faces(SolidId s) const {
        return {b->solid_faces(s).begin(), b->solid_faces(s).end()};
    }
    const std::vector<EdgeLoop>& face_loops(FaceId f) const {
        static std::vector<EdgeLoop> loops;
        return loops = {b->face_loops(f).begin(), b->face_loops(f).end()};
    }
    std::array<VertexId, 2> edge_vertices(EdgeId e) const { return b->edge_vertices(e); }
    Vec3 vertex_point(VertexId v) const { return b->vertex_point(v); }
    std::array<double, 2> edge_range(EdgeId e) const { return b->edge_range(e); }
    Vec3 edge_point(EdgeId e, double t) const { return b->edge_point(e, t); }
    Vec3 edge_derivative(EdgeId e, double t) const { return b->edge_derivative(e, t); }
    double edge_length(EdgeId e) const { return b->edge_length(e); }
    Vec3 face_point(FaceId f, const Vec2& uv) const { return b->face_point(f, uv); }
    std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const { return b->face_derivatives(f, uv); }
    Vec2 closest_on_face(FaceId f, const Vec3& x) const {
        const double away = 3 * std::round(2 * x.y());
        return b->closest_on_face(f, x) + Vec2(away * b->face_period(f)[0], 0);
    }
    Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        const Vec2 uv = b->edge_on_face(e, t, f, forward);
        const bool seam = b->edge_vertices(e)[0] != b->edge_vertices(e)[1];
        return uv + Vec2(seam ? 0 : b->face_period(f)[0] * (t > 2 ? 5 : -2), 0);
    }
    std::array<double, 2> face_period(FaceId f) const { return b->face_period(f); }
    int tag(int, std::size_t index) const { return static_cast<int>(index); }
};

}  // namespace

TEST_CASE("a box: corners, edges, faces, inside") {
    TestBrep b;
    add_prism(b, rectangle(2, 1), 0, 3);
    const ModelMesh mesh = swept(b, 4);
    const NodeEntities entities = checked_entities(b, mesh, 1e-12);
    CHECK(dimensions(entities) == std::array{8, 12 * 3, 6 * 9, 27});
    CHECK(entities.distance < 1e-14);
}

TEST_CASE("the numbering of nodes and quads does not matter") {
    TestBrep b;
    add_box_row(b, {0, 1, 2.5});
    const ModelMesh mesh = swept(b, 3);
    ModelMesh other = mesh;
    const Index last = static_cast<Index>(mesh.mesh.nodes.size() - 1);
    std::reverse(other.mesh.nodes.begin(), other.mesh.nodes.end());
    std::reverse(other.quads.begin(), other.quads.end());
    std::reverse(other.quad_face.begin(), other.quad_face.end());
    for (auto& quad : other.quads) {
        for (Index& i : quad) {
            i = last - i;
        }
    }
    for (auto& hex : other.mesh.hexes) {
        for (Index& i : hex) {
            i = last - i;
        }
    }
    NodeEntities turned = checked_entities(b, other, 1e-12);
    std::reverse(turned.of_node.begin(), turned.of_node.end());
    CHECK(turned.of_node == entities_of(b, mesh).of_node);
}

TEST_CASE("solids that share faces, and what is left when the quads between them are missing") {
    TestBrep b;
    add_box_row(b, {0, 1, 2.5, 3});
    ModelMesh mesh = swept(b, 3);
    CHECK(dimensions(checked_entities(b, mesh, 1e-12)) == std::array{16, 28 * 2, 16 * 4, 3 * 8});
    std::vector<bool> shared;
    for (const FaceId f : mesh.quad_face) {
        shared.push_back(f == FaceId{1});
    }
    std::vector<QuadCorners> quads;
    std::vector<FaceId> quad_face;
    std::set<Index> between;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (!shared[q]) {
            quads.push_back(mesh.quads[q]);
            quad_face.push_back(mesh.quad_face[q]);
        } else {
            between.insert(mesh.quads[q].begin(), mesh.quads[q].end());
        }
    }
    const NodeEntities all = entities_of(b, mesh);
    mesh.quads = quads;
    mesh.quad_face = quad_face;
    const NodeEntities entities = entities_of(b, mesh);
    int inside = 0;
    for (Index i = 0; i < mesh.mesh.nodes.size(); ++i) {
        const bool lost = all.of_node[i] == NodeEntity{2, 1, all.of_node[i].uv};
        inside += lost ? 1 : 0;
        CHECK(entities.of_node[i] == (lost ? NodeEntity{3, 0, Vec2::Zero()} : all.of_node[i]));
        CHECK((!lost || between.contains(i)));
    }
    CHECK(inside == 4);
}

TEST_CASE("a frustum of a cone with a seam; turned off its seam it has none, and no vertices") {
    TestBrep b;
    add_cylinder(b, 1, 0.6, 2);
    ModelMesh mesh = swept(b, 16);
    const NodeEntities entities = checked_entities(b, mesh, 1e-9);
    const std::array wanted{2, 2 * 15 + 15, 2 * 9 + 15 * 15, 15 * 9};
    CHECK(dimensions(entities) == wanted);
    for (Index i = 0; i < mesh.mesh.nodes.size(); ++i) {
        const Vec3& x = mesh.mesh.nodes[i];
        const double turn = std::atan2(x.y(), x.x()) / (2 * pi);
        if (entities.of_node[i].dimension == 2 && entities.of_node[i].id == 0) {
            CHECK(entities.of_node[i].uv[0] == Approx(turn < 0 ? turn + 1 : turn).epsilon(1e-9));
            CHECK(entities.of_node[i].uv[1] == Approx(x.z() / 2).margin(1e-9));
        }
    }
    const Foreign foreign{&b};
    const NodeEntities same = checked_entities(foreign, mesh, 1e-9);
    for (Index i = 0; i < mesh.mesh.nodes.size(); ++i) {
        CHECK(same.of_node[i].dimension == entities.of_node[i].dimension);
        CHECK(same.of_node[i].id == entities.of_node[i].id);
        CHECK((same.of_node[i].uv - entities.of_node[i].uv).norm() < 1e-12);
    }
    for (Vec3& x : mesh.mesh.nodes) {
        x = Eigen::AngleAxisd(pi / 16, Vec3::UnitZ()) * x;
    }
    const NodeEntities turned = entities_of(b, mesh);
    CHECK(dimensions(turned) == std::array{0, 2 * 16, 2 * 9 + 15 * 16, 15 * 9});
    CHECK(turned.distance < 1e-9);
    for (const NodeEntity& entity : turned.of_node) {
        CHECK((entity.dimension != 2 || entity.id != 0 || (entity.uv[0] > 0 && entity.uv[0] < 1)));
    }
}

TEST_CASE("a node near a seam is on it only within the tolerance and beside another") {
    TestBrep b;
    add_cylinder(b, 1, 1, 4);
    ModelMesh mesh = swept(b, 8);
    const auto on_seam = [&](double tolerance) {
        const NodeEntities entities = entities_of(b, mesh, {tolerance});
        return std::count_if(entities.of_node.begin(), entities.of_node.end(), [&](const NodeEntity& entity) {
            const auto ends = b.edge_vertices(EdgeId{std::max(entity.id, 0)});
            return entity.dimension == 1 && ends[0] != ends[1];
        });
    };
    CHECK(on_seam(1e-4) == 7);
    const double step = 0.5;  // the shortest edge there
    for (Vec3& x : mesh.mesh.nodes) {
        const bool alone = std::abs(x.z() - 0.5) > 0.1 && std::abs(x.z() - 2) > 0.1;
        if (x.z() > 0.1 && x.z() < 3.9 && alone) {
            x = Eigen::AngleAxisd(2e-3 * step, Vec3::UnitZ()) * x;
        }
    }
    CHECK(on_seam(1e-4) == 1);  // the one next to the vertex; the one in the middle is alone
    CHECK(on_seam(4e-3) == 7);
    CHECK(on_seam(0) <= 1);
}

TEST_CASE("two arcs between the same two faces, and quads of two faces alone") {
    TestBrep b;
    const VertexId right = b.vertex({1, 0, 0}), left = b.vertex({-1, 0, 0});
    const EdgeId upper = b.arc(right, left, {0, 0, 0}, {0, 0, 1});
    const EdgeId lower = b.arc(left, right, {0, 0, 0}, {0, 0, 1});
    const FaceId disc = b.flat({{{upper, true}, {lower, true}}}, {0, 0, 1});
    const EdgeLoop outer = b.polygon(lift(b, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, 0));
    const FaceId plate = b.flat({outer, {{lower, false}, {upper, false}}}, {0, 0, 1});
    FacesOnly faces;
    const Index middle = faces.node({0, 0, 0});
    const std::vector<Index> inner = ring(faces, 8, 1, 0), border = ring(faces, 8, 2, 0);
    for (std::size_t i = 0; i < 8; ++i) {
        Vec3& x = faces.mesh.nodes[border[i]];
        x /= x.cwiseAbs().maxCoeff() / 2;
        const std::size_t j = (i + 1) % 8;
        faces.quad(plate, inner[i], border[i], border[j], inner[j]);
        if (i % 2 == 0) {
            faces.quad(disc, middle, inner[i], inner[j], inner[(i + 2) % 8]);
        }
    }
    const NodeEntities entities = checked_entities(b, faces, 1e-12);
    CHECK(dimensions(entities) == std::array{6, 10, 1, 0});
    for (const std::size_t i : {1, 2, 3}) {
        CHECK(entities.of_node[inner[i]].id == upper.value);
        CHECK(entities.of_node[inner[i]].uv[0] == Approx(static_cast<double>(i) * pi / 4));
        CHECK(entities.of_node[inner[i + 4]].id == lower.value);
    }
}

TEST_CASE("the apex of a cone") {
    TestBrep b;
    const Ring base = add_circle(b, 1, 0), tip = add_circle(b, 0, 2);
    const FaceId wall = add_round_wall(b, base, tip);
    FacesOnly faces;
    const Index apex = faces.node({0, 0, 2});
    const std::vector<Index> high = ring(faces, 8, 0.5, 1), low = ring(faces, 8, 1, 0);
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t j = (i + 1) % 8;
        faces.quad(wall, low[i], low[j], high[j], high[i]);
        if (i % 2 == 0) {
            faces.quad(wall, high[i], high[j], high[(i + 2) % 8], apex);
        }
    }
    const NodeEntities entities = checked_entities(b, faces, 1e-9);
    CHECK(entities.of_node[apex] == NodeEntity{0, tip.v.value, Vec2::Zero()});
    CHECK(entities.of_node[low[0]] == NodeEntity{0, base.v.value, Vec2::Zero()});
    CHECK(entities.of_node[high[0]].dimension == 1);
    CHECK(entities.of_node[high[0]].uv[0] == Approx(0.5));
    CHECK(dimensions(entities) == std::array{2, 7 + 1, 7, 0});
}

TEST_CASE("a chamfer that the mesh leaves out: the nearest of the edges beside it, and the distance") {
    TestBrep b;
    add_prism(b, {{0, 0}, {2, 0}, {2, 1.96}, {1.98, 2}, {0, 2}}, 0, 3);
    TestBrep square;
    add_prism(square, rectangle(2, 2), 0, 3);
    ModelMesh mesh = swept(square, 4);
    for (FaceId& f : mesh.quad_face) {
        f = f.index() < 4 ? f : FaceId{f.value + 1};
    }
    const NodeEntities entities = entities_of(b, mesh);
    CHECK(dimensions(entities) == std::array{8, 12 * 3, 6 * 9, 27});
    CHECK(entities.distance == Approx(0.02));
    CHECK((mesh.mesh.nodes[entities.farthest] - Vec3(2, 2, mesh.mesh.nodes[entities.farthest].z())).norm() < 1e-12);
    for (Index i = 0; i < mesh.mesh.nodes.size(); ++i) {
        const Vec3& x = mesh.mesh.nodes[i];
        if (x.x() > 1.99 && x.y() > 1.99) {
            const Vec3 at = entity_point(b, entities.of_node[i]);
            CHECK((at - Vec3(1.98, 2, x.z())).norm() < 1e-12);
        }
    }
}

TEST_CASE("the middle of periodic parameters") {
    TestBrep b;
    add_cylinder(b, 1, 1, 2);
    const detail::Incidences around = detail::incidences(b);
    REQUIRE(around.face_seams[0].size() == 1);
    CHECK(detail::middle_parameters(b, FaceId{0}, around.face_seams[0])[0] == Approx(0.5));
    CHECK(detail::middle_parameters(Foreign{&b}, FaceId{0}, around.face_seams[0])[0] == Approx(0.5));
    CHECK(around.seam(around.face_seams[0][0]));
    CHECK_FALSE(around.pole(VertexId{0}));
}

TEST_CASE("nodes of no cell have no entity, wrong input is named") {
    TestBrep b;
    add_prism(b, rectangle(2, 1), 0, 3);
    ModelMesh mesh = swept(b, 2);
    mesh.mesh.nodes.emplace_back(7, 7, 7);
    CHECK(entities_of(b, mesh).of_node.back() == NodeEntity{3, -1, Vec2::Zero()});
    const NodeEntities none = node_entities(b, {}, {}, {}, {}, {});
    CHECK(none.of_node.empty());
    CHECK(none.farthest == no_index);
    const auto code = [&](auto&& spoil, double tolerance = 1e-4) {
        ModelMesh bad = mesh;
        spoil(bad);
        try {
            (void)entities_of(b, bad, {tolerance});
        } catch (const InputError& error) {
            return error.code();
        }
        throw std::logic_error("accepted");
    };
    CHECK(code([](ModelMesh& m) { m.quad_face.pop_back(); }) == ErrorCode::size_mismatch);
    CHECK(code([](ModelMesh& m) { m.hex_solid.pop_back(); }) == ErrorCode::size_mismatch);
    CHECK(code([](ModelMesh& m) { m.quad_face[3] = FaceId{6}; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.quad_face[3] = FaceId{}; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.hex_solid[3] = SolidId{1}; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.mesh.hexes[3][7] = 4711; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.quads[3][2] = 4711; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.quads[3][2] = m.quads[3][0]; }) == ErrorCode::bad_index);
    CHECK(code([](ModelMesh& m) { m.mesh.nodes[3].x() = std::nan(""); }) == ErrorCode::not_finite);
    CHECK(code([](ModelMesh&) {}, -1) == ErrorCode::bad_option);
    CHECK(code([](ModelMesh&) {}, std::nan("")) == ErrorCode::bad_option);
}

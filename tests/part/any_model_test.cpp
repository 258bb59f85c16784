#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/any_model.hpp>

#include <memory>
#include <type_traits>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Knows all that a model may know beyond brep.
struct Knowing : TestBrep {
    [[nodiscard]] std::string face_kind(FaceId f) const { return f.index() == 0 ? "Plane" : "Cylinder"; }
    [[nodiscard]] Vec2 face_interior(FaceId) const { return {0.25, 0.25}; }
    [[nodiscard]] double solid_volume(SolidId s) const { return 7 + static_cast<double>(s.index()); }
    [[nodiscard]] double diagonal() const { return 42; }
    [[nodiscard]] std::string face_name(FaceId f) const { return "face " + std::to_string(f.index()); }
    [[nodiscard]] const char* solid_name(SolidId) const { return "block"; }
};

void check_same(const TestBrep& b, const AnyModel& model) {
    REQUIRE(model.vertex_count() == b.vertex_count());
    REQUIRE(model.edge_count() == b.edge_count());
    REQUIRE(model.face_count() == b.face_count());
    REQUIRE(all_solids(model) == all_solids(b));
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(b.vertex_count()); ++v) {
        CHECK(model.vertex_point(VertexId{v}) == b.vertex_point(VertexId{v}));
    }
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.edge_count()); ++i) {
        const EdgeId e{i};
        const double t = 0.3 * b.edge_range(e)[0] + 0.7 * b.edge_range(e)[1];
        CHECK(model.edge_range(e) == b.edge_range(e));
        CHECK(model.edge_vertices(e) == b.edge_vertices(e));
        CHECK(model.edge_point(e, t) == b.edge_point(e, t));
        CHECK(model.edge_derivative(e, t) == b.edge_derivative(e, t));
        CHECK(model.edge_length(e) == b.edge_length(e));
        CHECK(model.tag(1, e.index()) == b.tag(1, e.index()));
    }
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.face_count()); ++i) {
        const FaceId f{i};
        const Vec2 uv(0.1, 0.2);
        CHECK(model.face_loops(f).data() == b.face_loops(f).data());
        CHECK(model.face_point(f, uv) == b.face_point(f, uv));
        CHECK(model.face_derivatives(f, uv) == b.face_derivatives(f, uv));
        CHECK(model.closest_on_face(f, {1, 2, 3}) == b.closest_on_face(f, {1, 2, 3}));
        CHECK(model.face_period(f) == b.face_period(f));
        const OrientedEdge use = b.face_loops(f)[0][0];
        const double t = b.edge_range(use.edge)[0];
        CHECK(model.edge_on_face(use.edge, t, f, use.forward) == b.edge_on_face(use.edge, t, f, use.forward));
    }
    for (const SolidId s : all_solids(b)) {
        CHECK(model.solid_faces(s).data() == b.solid_faces(s).data());
    }
}

}  // namespace

TEST_CASE("A view of any model gives what the model gives") {
    static_assert(!std::is_constructible_v<AnyModel, TestBrep&&>, "a view of a temporary would dangle");
    static_assert(!std::is_convertible_v<int, AnyModel>);
    TestBrep b;
    add_prism(b, l_shape(), 0, 1);
    add_cylinder(b, 1, 1, 2);
    check_same(b, b);
    const archetype::Brep archetype(b);
    const AnyModel view = archetype;
    const AnyModel copy = view;
    CHECK(copy.face_point(FaceId{0}, {0.5, 0.5}) == b.face_point(FaceId{0}, {0.5, 0.5}));
}

TEST_CASE("What a model knows beyond the concept is kept, what it does not is not made up") {
    Knowing b;
    add_prism(b, l_shape(), 0, 1);
    const AnyModel knowing = b;
    CHECK(is_plane(knowing, FaceId{0}));
    CHECK_FALSE(is_plane(knowing, FaceId{1}));
    REQUIRE(plane_of(knowing, FaceId{0}));
    CHECK(plane_of(knowing, FaceId{0})->point == plane_of(b, FaceId{0})->point);
    CHECK_FALSE(plane_of(knowing, FaceId{1}));
    CHECK(volume_of(knowing, SolidId{0}) == 7.0);
    CHECK(diagonal_of(knowing) == 42);
    CHECK(name_of(knowing, FaceId{2}) == "face 2");
    CHECK(name_of(knowing, SolidId{0}) == "block");
    const archetype::Brep plain(static_cast<const TestBrep&>(b));
    const AnyModel ignorant = plain;
    CHECK_FALSE(is_plane(ignorant, FaceId{0}));
    CHECK_FALSE(plane_of(ignorant, FaceId{0}));
    CHECK_FALSE(volume_of(ignorant, SolidId{0}));
    CHECK(diagonal_of(ignorant) == diagonal_of(plain));
    CHECK(name_of(ignorant, SolidId{0}).empty());
}

#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/smooth/improve_hexes.hpp>
#include <pavior/smooth/pillow.hpp>

#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <vector>

using namespace pavior;

namespace {

using Positions = std::vector<std::size_t>;

/// The boundary of a mesh and the quads between groups of its hexahedra, each in the group that \p group_of names.
HexMeshData with_quads(HexMesh mesh, const std::function<int(const Vec3& centre)>& group_of,
                       const std::function<int(const Vec3& centre)>& solid_of = {}) {
    HexMeshData data;
    data.mesh = std::move(mesh);
    const auto centre = [&](const auto& corners) {
        Vec3 sum = Vec3::Zero();
        for (const Index i : corners) {
            sum += data.mesh.nodes[i];
        }
        return Vec3(sum / static_cast<double>(corners.size()));
    };
    for (const QuadCorners& quad : boundary_quads(data.mesh)) {
        data.quads.push_back(quad);
        data.quad_groups.push_back(group_of(centre(quad)));
    }
    for (const HexCorners& hex : data.mesh.hexes) {
        data.hex_groups.push_back(solid_of ? solid_of(centre(hex)) : 1);
    }
    const FaceTable table(data.mesh);
    table.for_each(data.mesh, 0, data.mesh.nodes.size(), [&](Index, std::span<const FaceTable::Use> uses) {
        if (uses.size() == 2 && data.hex_groups[uses[0].hex()] != data.hex_groups[uses[1].hex()]) {
            const bool first = data.hex_groups[uses[0].hex()] < data.hex_groups[uses[1].hex()];
            const FaceTable::Use& own = uses[first ? 0 : 1];
            data.quads.push_back(hex_face(data.mesh.hexes[own.hex()], own.local()));
            data.quad_groups.push_back(99);
        }
    });
    return data;
}

/// 1, 2: low and high x; 3, 4: y; 5, 6: z of a box from the origin.
std::function<int(const Vec3&)> sides_of(const Vec3& size) {
    return [size](const Vec3& x) {
        for (int k = 0; k < 3; ++k) {
            if (x[k] < 1e-9 || x[k] > size[k] - 1e-9) {
                return 2 * k + (x[k] < 1e-9 ? 1 : 2);
            }
        }
        return 0;
    };
}

HexMeshData box(std::size_t nx, std::size_t ny, std::size_t nz) {
    const Vec3 size(static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz));
    return with_quads(shapes::hex_box(nx, ny, nz, size), sides_of(size));
}

Positions of_groups(const HexMeshData& data, const std::set<int>& groups) {
    Positions result;
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (groups.contains(data.quad_groups[q])) {
            result.push_back(q);
        }
    }
    return result;
}

std::size_t count(const HexMeshData& data, int group) { return of_groups(data, {group}).size(); }

double area(const HexMeshData& data, int group) {
    double sum = 0;
    for (const std::size_t q : of_groups(data, {group})) {
        const auto& x = data.mesh.nodes;
        const QuadCorners& c = data.quads[q];
        sum += (x[c[2]] - x[c[0]]).cross(x[c[3]] - x[c[1]]).norm() / 2;  // of a plane quad
    }
    return sum;
}

/// Conforming, positive, its outer quads those listed but for group 99, in sense and number.
void require_sound(const HexMeshData& data, double volume) {
    const MeshCheck check = check_mesh(data.mesh);
    INFO(check.verify.text());
    REQUIRE(check.valid());
    CHECK(check.verify.crossed_edges == 0);
    CHECK(check.verify.volume == Approx(volume).epsilon(1e-12));
    REQUIRE(data.quads.size() == data.quad_groups.size());
    REQUIRE(data.mesh.hexes.size() == data.hex_groups.size());
    std::vector<QuadCorners> listed;
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (data.quad_groups[q] != 99) {
            listed.push_back(from_smallest(data.quads[q]));
        }
    }
    std::vector<QuadCorners> outer = boundary_quads(data.mesh);
    std::sort(listed.begin(), listed.end());
    std::sort(outer.begin(), outer.end());
    CHECK(listed == outer);
    const auto faces = faces_under_quads(data.mesh, data.quads);
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (data.quad_groups[q] == 99) {
            REQUIRE(faces[q][1].hex != no_index);
            CHECK(data.hex_groups[faces[q][0].hex] != data.hex_groups[faces[q][1].hex]);
            const HexFace& own = faces[q][data.hex_groups[faces[q][0].hex] < data.hex_groups[faces[q][1].hex] ? 0 : 1];
            CHECK(from_smallest(hex_face(data.mesh.hexes[own.hex], own.face)) == from_smallest(data.quads[q]));
        }
    }
}

void require_same(const HexMeshData& a, const HexMeshData& b) {
    CHECK(a.mesh.nodes == b.mesh.nodes);
    CHECK(a.mesh.hexes == b.mesh.hexes);
    CHECK(a.quads == b.quads);
    CHECK(a.quad_groups == b.quad_groups);
    CHECK(a.hex_groups == b.hex_groups);
}

/// Groups keep their planes, so edges and corners of the box are where they were.
void require_sides(const HexMeshData& data, const Vec3& size) {
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        const int group = data.quad_groups[q];
        for (const Index i : data.quads[q]) {
            const int axis = (group - 1) / 2;
            CHECK(data.mesh.nodes[i][axis] == Approx(group % 2 == 1 ? 0.0 : size[axis]).margin(1e-12));
        }
    }
    for (int group = 1; group <= 6; ++group) {
        const int axis = (group - 1) / 2;
        CHECK(area(data, group) == Approx(size.prod() / size[axis]));
    }
}

}  // namespace

TEST_CASE("One side of a box: a layer as thick as asked, strips on the four sides beside it") {
    HexMeshData data = box(3, 4, 2);
    const HexMeshData before = data;
    PillowOptions options;
    options.fraction = 0.25;
    const PillowReport report = pillow(data, of_groups(data, {6}), options);
    CHECK(report.ok());
    CHECK(report.inverted == 0);
    CHECK(report.node_from.size() == 4 * 5);
    CHECK(report.hex_from.size() == 3 * 4);
    CHECK(report.quad_from.size() == 2 * (3 + 4));
    CHECK(data.mesh.hexes.size() == 24 + 12);
    CHECK(data.mesh.nodes.size() == 60 + 20);
    require_sound(data, 24);
    require_sides(data, {3, 4, 2});
    CHECK(count(data, 1) == 12);
    CHECK(count(data, 3) == 9);
    CHECK(count(data, 5) == 12);
    CHECK(count(data, 6) == 12);
    for (std::size_t i = 0; i < before.mesh.nodes.size(); ++i) {
        CHECK(data.mesh.nodes[i] == before.mesh.nodes[i]);
    }
    for (std::size_t i = 0; i < report.node_from.size(); ++i) {
        CHECK((data.mesh.nodes[60 + i] - before.mesh.nodes[report.node_from[i]] + Vec3(0, 0, 0.25)).norm() < 1e-12);
    }
    for (std::size_t i = 0; i < report.hex_from.size(); ++i) {
        CHECK(data.mesh.hexes[24 + i][0] == data.mesh.hexes[report.hex_from[i]][4]);
    }
    CHECK(check_mesh(data.mesh).quality.scaled_jacobian.min == Approx(1));
}

TEST_CASE("Adjacent and opposite sides, all of them, and one cube from all sides") {
    for (const auto& [groups, quads] : std::vector<std::pair<std::set<int>, std::size_t>>{
             {{2, 6}, 18}, {{5, 6}, 18}, {{2, 4, 6}, 27}, {{1, 2, 6}, 27}, {{1, 2, 3, 4, 5, 6}, 54}}) {
        HexMeshData data = box(3, 3, 3);
        std::set<Index> nodes;
        for (const std::size_t q : of_groups(data, groups)) {
            nodes.insert(data.quads[q].begin(), data.quads[q].end());
        }
        const PillowReport report = pillow(data, of_groups(data, groups));
        CHECK(report.ok());
        CHECK(report.inverted == 0);
        CHECK(data.mesh.hexes.size() == 27 + quads);
        CHECK(data.mesh.nodes.size() == 64 + nodes.size());
        CHECK(std::set<Index>(report.node_from.begin(), report.node_from.end()) == nodes);
        require_sound(data, 27);
        require_sides(data, {3, 3, 3});
        CHECK(check_mesh(data.mesh).quality.scaled_jacobian.min > 0.5);
    }
    HexMeshData cube = box(1, 1, 1);
    PillowOptions thin;
    thin.fraction = 0.3;
    CHECK(pillow(cube, of_groups(cube, {1, 2, 3, 4, 5, 6}), thin).ok());
    CHECK(cube.mesh.hexes.size() == 7);
    CHECK(cube.quads.size() == 6);
    for (std::size_t i = 8; i < 16; ++i) {  // 0.15 of the way in from either side
        const Vec3 in = 2 * cube.mesh.nodes[i] - Vec3::Ones();
        CHECK((in.cwiseAbs() - Vec3::Constant(0.7)).norm() < 1e-12);
    }
    require_sound(cube, 1);
    HexMeshData tube = box(1, 1, 1);
    CHECK(pillow(tube, of_groups(tube, {1, 2, 3, 4})).ok());
    CHECK(tube.mesh.hexes.size() == 5);
    CHECK(count(tube, 5) == 5);
    CHECK(count(tube, 6) == 5);
    require_sound(tube, 1);
    require_sides(tube, {1, 1, 1});
}

TEST_CASE("A concave edge between chosen sides") {
    HexMesh mesh = shapes::extrusion(shapes::l_shape(2), 2);
    const double volume = check_mesh(mesh).verify.volume;
    HexMeshData data = with_quads(std::move(mesh), [](const Vec3& x) {
        return x.z() < 1e-9 ? 1 : x.z() > 1 - 1e-9 ? 2 : 3;
    });
    const std::size_t walls = count(data, 3), hexes = data.mesh.hexes.size();
    const PillowReport report = pillow(data, of_groups(data, {3}));
    CHECK(report.ok());
    CHECK(report.inverted == 0);
    CHECK(data.mesh.hexes.size() == hexes + walls);
    CHECK(report.quad_from.size() == walls);
    require_sound(data, volume);
    HexMeshData floor = with_quads(shapes::extrusion(shapes::l_shape(2), 2), [](const Vec3& x) {
        return x.z() < 1e-9 ? 1 : x.z() > 1 - 1e-9 ? 2 : 3;
    });
    CHECK(pillow(floor, of_groups(floor, {2})).ok());
    require_sound(floor, volume);
}

TEST_CASE("Inside a mesh: the classical pillow round a shrink set") {
    HexMeshData data = box(3, 3, 3);
    std::vector<char> shrink(27, 0);
    shrink[13] = 1;
    Positions all;
    for (std::size_t f = 0; f < 6; ++f) {
        all.push_back(data.quads.size());
        data.quads.push_back(hex_face(data.mesh.hexes[13], f));
        data.quad_groups.push_back(7);
    }
    PillowOptions options;
    options.shrink = shrink;
    const HexMeshData before = data;
    const PillowReport open = pillow(data, std::span(all).first(5), options);
    CHECK(open.fault == PillowFault::open_rim);
    CHECK(open.fault_nodes.size() == 4);
    require_same(data, before);
    const PillowReport report = pillow(data, all, options);
    CHECK(report.ok());
    CHECK(data.mesh.hexes.size() == 33);
    CHECK(report.node_from.size() == 8);
    CHECK(report.quad_from.empty());
    CHECK(check_mesh(data.mesh).valid());
    CHECK(check_mesh(data.mesh).verify.volume == Approx(27));
    for (std::size_t h = 0; h < 27; ++h) {
        CHECK((data.mesh.hexes[h] == before.mesh.hexes[h]) == (h != 13));
    }
    for (const std::size_t q : all) {
        CHECK(data.quads[q] == before.quads[q]);
    }
}

TEST_CASE("Solids that share a face: the layer goes through both, or round one of them, or is refused") {
    const auto two = [](int left, int right) {
        const Vec3 size(4, 2, 2);
        return with_quads(shapes::hex_box(4, 2, 2, size), sides_of(size),
                          [=](const Vec3& x) { return x.x() < 2 ? left : right; });
    };
    const auto tops = [](const HexMeshData& data, bool right) {
        Positions result;
        for (const std::size_t q : of_groups(data, {6})) {
            const QuadCorners& c = data.quads[q];
            const double x = (data.mesh.nodes[c[0]] + data.mesh.nodes[c[2]]).x() / 2;
            if (x < 2 || right) {
                result.push_back(q);
            }
        }
        return result;
    };
    for (const auto& [low, high] : {std::pair{1, 2}, {2, 1}}) {  // the quads between them look either way
        HexMeshData data = two(low, high);
        CHECK(pillow(data, tops(data, true)).ok());
        require_sound(data, 16);
    }
    HexMeshData data = two(1, 2);
    const HexMeshData before = data;
    CHECK(count(data, 99) == 4);

    const PillowReport through = pillow(data, tops(data, true));
    CHECK(through.ok());
    CHECK(through.quad_from.size() == 12 + 2);
    CHECK(count(data, 99) == 6);
    CHECK(area(data, 99) == Approx(4));
    require_sound(data, 16);

    data = before;
    const PillowReport foreign = pillow(data, tops(data, false));
    CHECK(foreign.fault == PillowFault::foreign_rim);
    CHECK(foreign.fault_nodes.size() == 3);
    require_same(data, before);

    std::vector<char> left;
    for (const std::int32_t group : data.hex_groups) {
        left.push_back(group == 1 ? 1 : 0);
    }
    PillowOptions options;
    options.shrink = left;
    CHECK(pillow(data, tops(data, false), options).fault == PillowFault::open_rim);
    require_same(data, before);

    Positions round = tops(data, false);
    const Positions shared = of_groups(data, {99});
    round.insert(round.end(), shared.begin(), shared.end());
    const PillowReport around = pillow(data, round, options);
    CHECK(around.ok());
    CHECK(data.mesh.hexes.size() == 16 + 8);
    CHECK(std::count(data.hex_groups.begin(), data.hex_groups.end(), 2) == 8);
    CHECK(count(data, 99) == 4);
    require_sound(data, 16);
    for (std::size_t h = 0; h < 16; ++h) {
        CHECK((before.hex_groups[h] == 1 || data.mesh.hexes[h] == before.mesh.hexes[h]));
    }
    CHECK_THROWS_AS(pillow(data, shared), InputError);  // all are in the set
}

TEST_CASE("Rims that would lose a feature or touch themselves are refused") {
    HexMeshData data = box(2, 2, 1);
    const auto relabel = [&](const std::array<int, 4>& groups) {
        for (const std::size_t q : of_groups(data, {6, 11, 12, 13, 14})) {
            const Vec3 centre = (data.mesh.nodes[data.quads[q][0]] + data.mesh.nodes[data.quads[q][2]]) / 2;
            data.quad_groups[q] = groups[(centre.x() > 1 ? 1U : 0U) + (centre.y() > 1 ? 2U : 0U)];
        }
    };
    relabel({11, 12, 13, 14});
    HexMeshData before = data;
    const PillowReport lost = pillow(data, of_groups(data, {11}));
    CHECK(lost.fault == PillowFault::split_feature);
    CHECK(lost.fault_nodes.size() == 1);
    require_same(data, before);
    relabel({11, 12, 12, 11});
    before = data;
    const PillowReport pinched = pillow(data, of_groups(data, {11}));
    CHECK(pinched.fault == PillowFault::pinched);
    CHECK(pinched.fault_nodes == lost.fault_nodes);
    require_same(data, before);
    PillowOptions options;
    const std::vector<char> shrink{1, 1, 1, 0};
    options.shrink = shrink;
    relabel({11, 12, 12, 12});
    before = data;
    CHECK(pillow(data, of_groups(data, {11}), options).fault == PillowFault::open_rim);  // beside a node of it
    require_same(data, before);
    relabel({11, 11, 12, 13});  // one line leaves, which the double follows
    CHECK(pillow(data, of_groups(data, {11})).ok());
    CHECK(verify_hexes(data.mesh, {.samples = 1}).count(MeshFault::inverted) >
          0);  // quads of a plane beside each other
    CHECK(area(data, 12) == Approx(1));
    CHECK(area(data, 13) == Approx(1));
    CHECK(count(data, 12) == 2);
    CHECK(count(data, 13) == 2);
}

TEST_CASE("A boundary that touches itself at an edge: both sides get their own doubles") {
    HexMesh mesh = shapes::hex_box(2, 2, 1, Vec3(2, 2, 1));
    mesh.hexes = {mesh.hexes[0], mesh.hexes[3]};
    HexMeshData data = with_quads(std::move(mesh), [](const Vec3&) { return 1; });
    CHECK(pillow(data, of_groups(data, {1})).ok());
    CHECK(data.mesh.hexes.size() == 14);
    const HexReport report = verify_hexes(data.mesh, {.allow_unused_nodes = true});
    CHECK(report.ok());
    CHECK(report.volume == Approx(2));
    CHECK(report.crossed_edges == 1);
}

TEST_CASE("An edge with hexahedra on two sides that hang together at its ends is refused") {
    HexMesh mesh = shapes::hex_box(2, 2, 3, Vec3(2, 2, 3));
    mesh.hexes.erase(mesh.hexes.begin() + 5, mesh.hexes.begin() + 7);
    HexMeshData data = with_quads(std::move(mesh), [](const Vec3&) { return 1; });
    const HexMeshData before = data;
    const PillowReport report = pillow(data, of_groups(data, {1}));
    CHECK(report.fault == PillowFault::pinched);
    CHECK(report.fault_nodes == std::vector<Index>{13, 22});
    require_same(data, before);
}

TEST_CASE("A grid bent into a cylinder becomes an O-grid; its flat hexahedra become good") {
    constexpr std::size_t n = 6;
    constexpr double radius = 2;
    HexMesh mesh = shapes::hex_box(n, n, 3, Vec3(2, 2, 3));
    for (Vec3& x : mesh.nodes) {
        const Vec2 p(x.x() - 1, x.y() - 1);
        const double reach = p.lpNorm<Eigen::Infinity>();
        x.head<2>() = reach > 0 ? Vec2(radius * reach * p.normalized()) : Vec2(Vec2::Zero());
    }
    HexMeshData data = with_quads(std::move(mesh), [](const Vec3& x) {
        return x.z() < 1e-9 ? 1 : x.z() > 3 - 1e-9 ? 2 : 3;
    });
    const MeshCheck flat = check_mesh(data.mesh);
    CHECK(flat.quality.scaled_jacobian.min < 0.3);
    const double volume = flat.verify.volume;
    const auto improved = [](HexMeshData& some) {
        std::vector<Freedom> freedoms(some.mesh.nodes.size(), Freedom::space);
        for (std::size_t q = 0; q < some.quads.size(); ++q) {
            for (const Index i : some.quads[q]) {
                const Freedom slides = some.quad_groups[q] == 3 ? Freedom::fixed : Freedom::surface;
                freedoms[i] = std::min(freedoms[i], slides);
            }
        }
        const GuidedNodes guide{freedoms,
                                [&](Index, const Vec3& x) { return Vec3(x.x(), x.y(), x.z() < 1.5 ? 0 : 3); }};
        return improve_hexes(some.mesh.nodes, some.mesh.hexes, guide, {.target = 0.6}).min_det_after;
    };
    HexMeshData without = data;
    const double before = improved(without);
    CHECK(before < 0.3);  // the wall alone decides
    const PillowReport report = pillow(data, of_groups(data, {3}));
    CHECK(report.ok());
    CHECK(report.inverted == 0);
    CHECK(report.hex_from.size() == 4 * n * 3);
    require_sound(data, volume);
    CHECK(count(data, 1) == n * n + 4 * n);
    CHECK(count(data, 3) == 4 * n * 3);
    CHECK(check_mesh(data.mesh).quality.scaled_jacobian.min > flat.quality.scaled_jacobian.min + 0.02);
    CHECK(improved(data) > 0.45);
    require_sound(data, volume);
}

TEST_CASE("Doubles move back where hexahedra would be inverted") {
    std::mt19937 engine(7);
    const auto random = [&](double reach) {
        return reach * (2.0 * static_cast<double>(engine()) / 4294967295.0 - 1.0);
    };
    std::size_t tried = 0;
    for (int round = 0; round < 500; ++round) {
        HexMeshData data = box(2, 2, 2);
        for (Vec3& x : data.mesh.nodes) {
            x += Vec3(random(0.3), random(0.3), random(0.3));
        }
        const MeshCheck check = check_mesh(data.mesh);
        if (!(check.quality.scaled_jacobian.min > 0.2)) {
            continue;
        }
        ++tried;
        std::set<int> groups;
        for (int group = 1; group <= 6; ++group) {
            if (engine() % 2 == 0) {
                groups.insert(group);
            }
        }
        PillowOptions options;
        options.fraction = 0.9;
        const PillowReport report = pillow(data, of_groups(data, groups), options);
        REQUIRE(report.ok());
        CHECK(report.inverted == 0);
        CHECK(verify_hexes(data.mesh).ok());
    }
    CHECK(tried > 20);
}

TEST_CASE("Any mesh, any quads, in any order: the same bytes; mistakes are named") {
    const HexMeshData data = box(3, 2, 2);
    HexMeshData own = data;
    const Positions chosen = of_groups(data, {6, 4});
    const PillowReport report = pillow(own, chosen);
    Positions other(chosen.rbegin(), chosen.rend());
    other.push_back(chosen[0]);
    const archetype::Hexes foreign(data.mesh);
    std::vector<std::array<int, 4>> quads;
    for (const QuadCorners& c : data.quads) {
        quads.push_back(
            {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])});
    }
    const PillowedMesh made = pillow(foreign, std::span<const std::array<int, 4>>(quads), data.quad_groups, other);
    CHECK(made.report.node_from == report.node_from);
    CHECK(made.data.mesh.nodes == own.mesh.nodes);
    CHECK(made.data.mesh.hexes == own.mesh.hexes);
    CHECK(made.data.quads == own.quads);
    CHECK(made.data.quad_groups == own.quad_groups);
    CHECK(made.data.hex_groups.empty());
    const PillowedMesh bare = pillow(foreign, std::span<const std::array<int, 4>>(quads), {}, other);
    CHECK(bare.report.ok());
    CHECK(bare.data.mesh.hexes == own.mesh.hexes);

    HexMeshData copy = data;
    const Positions beyond{copy.quads.size()};
    CHECK_THROWS_AS(pillow(copy, beyond), InputError);
    for (const double fraction : {0.0, 1.0, -1.0, std::nan("")}) {
        PillowOptions options;
        options.fraction = fraction;
        CHECK_THROWS_AS(pillow(copy, chosen, options), InputError);
    }
    PillowOptions options;
    const std::vector<char> few(3, 1);
    options.shrink = few;
    CHECK_THROWS_AS(pillow(copy, chosen, options), InputError);
    const std::vector<char> none(12, 0);
    options.shrink = none;
    CHECK_THROWS_AS(pillow(copy, chosen, options), InputError);
    copy.quad_groups.pop_back();
    CHECK_THROWS_AS(pillow(copy, chosen), InputError);
    copy = data;
    copy.quads[0][0] = 1000;
    CHECK_THROWS_AS(pillow(copy, chosen), InputError);
    copy = data;
    copy.mesh.hexes[3][2] = 1000;
    CHECK_THROWS_AS(pillow(copy, chosen), InputError);
    copy = data;
    copy.mesh.hexes.push_back(copy.mesh.hexes.back());
    copy.hex_groups.push_back(1);
    CHECK_THROWS_AS(pillow(copy, chosen), InputError);
    copy = data;
    CHECK(pillow(copy, {}).ok());
    require_same(copy, data);
    CHECK(to_string(PillowFault::split_feature) == "split_feature");
}

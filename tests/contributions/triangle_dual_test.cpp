#include "support/catch.hpp"

#include <pavior/contributions/triangle_dual.hpp>
#include <pavior/mesh/eigen_access.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace pavior;

namespace archetype {
// Triangles on integer coordinates, computed when asked for.
struct Strip {
    Index cells;
};
}  // namespace archetype
template <>
struct pavior::mesh_access<archetype::Strip> {
    static unsigned node_count(const archetype::Strip& m) { return 2 * m.cells + 2; }
    static std::array<float, 3> node(const archetype::Strip&, Index i) {
        return {static_cast<float>(i / 2), static_cast<float>(i % 2), 0.0F};
    }
    static unsigned triangle_count(const archetype::Strip& m) { return 2 * m.cells; }
    static std::array<long, 3> triangle(const archetype::Strip&, Index t) {
        const long a = 2 * static_cast<long>(t / 2);
        return t % 2 == 0 ? std::array<long, 3>{a, a + 2, a + 3} : std::array<long, 3>{a, a + 3, a + 1};
    }
};

namespace {
struct Pixels {
    TriMesh mesh;
    TriangleMarks marks;
    std::array<std::size_t, 3> strata{};
};

// A union of pixels, fine x fine boxes of two triangles in each, with cuts at all pixel sides.
Pixels pixels(Index width, Index height, const std::vector<char>& inside, Index fine) {
    Pixels p;
    std::map<std::pair<Index, Index>, Index> id;
    const auto node = [&](Index i, Index j) {
        const auto [at, added] = id.try_emplace({i, j}, static_cast<Index>(id.size()));
        if (added) {
            p.mesh.nodes.push_back(Vec3(i, j, 0) / fine);
        }
        return at->second;
    };
    std::set<std::array<Index, 2>> edges;
    std::set<std::pair<Index, Index>> corners;
    for (Index j = 0; j < height * fine; ++j) {
        for (Index i = 0; i < width * fine; ++i) {
            const Index x = i / fine;
            const Index y = j / fine;
            if (inside[y * width + x] == 0) {
                continue;
            }
            const Index a = node(i, j);
            const Index b = node(i + 1, j);
            const Index c = node(i + 1, j + 1);
            const Index d = node(i, j + 1);
            p.mesh.triangles.push_back({a, b, c});
            p.mesh.triangles.push_back({a, c, d});
            const auto cut = [&](bool on, Index from, Index to) {
                if (on) {
                    edges.insert({std::min(from, to), std::max(from, to)});
                }
            };
            cut(j % fine == 0, a, b);
            cut((j + 1) % fine == 0, c, d);
            cut(i % fine == 0, d, a);
            cut((i + 1) % fine == 0, b, c);
            p.strata[2] += i % fine == 0 && j % fine == 0 ? 1 : 0;
            for (const Index dx : {0U, 1U}) {
                for (const Index dy : {0U, 1U}) {
                    corners.insert({x + dx, y + dy});
                }
            }
        }
    }
    p.marks.layers.assign(edges.begin(), edges.end());
    p.strata[0] = corners.size();
    p.strata[1] = edges.size() / fine;
    for (const auto& [x, y] : corners) {
        p.marks.vertices.push_back(id.at({x * fine, y * fine}));
    }
    return p;
}
}  // namespace

TEST_CASE("a rectangle gives four blocks over nine nodes") {
    const archetype::Strip strip{5};
    const std::vector<Index> corners = corner_nodes(strip);
    CHECK(corners == std::vector<Index>{0, 1, 10, 11});
    const TriangleDual dual = triangle_dual(strip, {corners, {}});
    CHECK(dual.blocks.size() == 4);
    CHECK(dual.regions == 9);
    CHECK(dual.irregular == 0);
    const QuadMesh quads = block_quads(strip, dual);
    CHECK(verify_quads(quads).ok());
    CHECK(verify_quads(quads).boundary_edges == 8);
    std::set<std::pair<double, double>> places;
    for (const Vec3& x : quads.nodes) {
        places.insert({x.x(), x.y()});
    }
    CHECK(places == std::set<std::pair<double, double>>{
                        {0, 0}, {0, 0.5}, {0, 1}, {2.5, 0}, {2.5, 0.5}, {2.5, 1}, {5, 0}, {5, 0.5}, {5, 1}});
}

TEST_CASE("a triangle gives three blocks; its classes and contributions") {
    const TriMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
    const TriangleDual dual = triangle_dual(mesh, {corner_nodes(mesh), {}});
    CHECK(dual.blocks.size() == 3);
    CHECK(dual.regions == 7);
    for (const Contribution c : dual.contributions[0]) {
        CHECK(c == Contribution::hard);
    }
    CHECK(dual.region_dimension == std::vector<int>{2, 1, 1, 1, 0, 0, 0});
}

TEST_CASE("property: the midpoint subdivision of the faces, on random unions of pixels") {
    const unsigned seed = 12;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int n = 0; n < 60; ++n) {
        const Index width = 1 + static_cast<Index>(random() % 4);
        const Index height = 1 + static_cast<Index>(random() % 4);
        std::vector<char> inside(std::size_t{width} * height);
        for (char& in : inside) {
            in = random() % 3 != 0 ? 1 : 0;
        }
        inside[0] = 1;
        const Pixels p = pixels(width, height, inside, 1 + static_cast<Index>(n % 3));
        const TriangleDual dual = triangle_dual(p.mesh, p.marks);
        CHECK(dual.irregular == 0);
        CHECK(dual.blocks.size() == 4 * p.strata[2]);
        CHECK(dual.regions == p.strata[0] + p.strata[1] + p.strata[2]);
        // Each block is a quarter of a pixel, with its corners where midpoint subdivision puts them.
        const QuadMesh quads = block_quads(p.mesh, dual);
        std::set<std::array<int, 2>> quarters;
        bool placed = true;
        for (const QuadCorners& q : quads.quads) {
            const Vec3 v = quads.nodes[q[0]];
            const Vec3 face = quads.nodes[q[2]];
            const Vec3 side = face - v;
            placed = placed && std::abs(std::abs(side.x()) - 0.5) < 1e-12 && std::abs(std::abs(side.y()) - 0.5) < 1e-12;
            const bool x_first = side.x() * side.y() > 0.0;
            const Vec3 x_step = v + Vec3(side.x(), 0, 0);
            const Vec3 y_step = v + Vec3(0, side.y(), 0);
            placed = placed && (quads.nodes[q[1]] - (x_first ? x_step : y_step)).norm() < 1e-12 &&
                     (quads.nodes[q[3]] - (x_first ? y_step : x_step)).norm() < 1e-12;
            quarters.insert({static_cast<int>(std::lround(2.0 * (v + face).x())),
                             static_cast<int>(std::lround(2.0 * (v + face).y()))});
        }
        CHECK(placed);
        CHECK(quarters.size() == dual.blocks.size());
    }
}

TEST_CASE("re-entrant corners want cuts; without them the corner is a quadrilateral of a face with six corners") {
    const Pixels p = pixels(2, 2, {1, 1, 1, 0}, 2);
    const std::vector<Index> corners = corner_nodes(p.mesh);
    CHECK(corners.size() == 6);
    const TriangleDual dual = triangle_dual(p.mesh, {corners, {}});
    CHECK(dual.blocks.size() == 6);
    CHECK(dual.regions == 13);
    CHECK(corner_nodes(p.mesh, 135.0, 280.0).size() == 5);
}

TEST_CASE("marks that give no blocks are counted") {
    const Pixels p = pixels(1, 1, {1}, 3);
    const TriangleDual none = triangle_dual(p.mesh, {});
    CHECK(none.blocks.empty());
    CHECK(none.regions == 2);
    // A vertex inside, without layers; one on a side, with one chain on both sides of it.
    Index inner = no_index;
    for (Index i = 0; i < p.mesh.nodes.size(); ++i) {
        const Vec3& x = p.mesh.nodes[i];
        inner = x.x() > 0.1 && x.x() < 0.9 && x.y() > 0.1 && x.y() < 0.9 ? i : inner;
    }
    CHECK(triangle_dual(p.mesh, {{inner}, {}}).irregular == 1);
    CHECK(triangle_dual(p.mesh, {{corner_nodes(p.mesh)[0]}, {}}).irregular == 1);
}

TEST_CASE("foreign mesh, unused nodes, errors") {
    Eigen::MatrixXd v(5, 2);
    v << 0, 0, 1, 0, 1, 1, 0, 1, 9, 9;
    Eigen::Matrix<long, Eigen::Dynamic, 3> f(2, 3);
    f << 0, 1, 2, 0, 2, 3;
    const EigenTriMesh mesh(v, f);
    const TriangleDual dual = triangle_dual(mesh, {corner_nodes(mesh), {}});
    CHECK(dual.blocks.size() == 4);
    CHECK(dual.regions == 9);
    CHECK(dual.node_region[4] == no_index);
    CHECK_THROWS_AS(triangle_dual(mesh, {{7}, {}}), InputError);
    CHECK_THROWS_AS(triangle_dual(mesh, {{}, {{1, 3}}}), InputError);
    f(1, 2) = 8;
    CHECK_THROWS_AS(triangle_dual(mesh, {}), InputError);
    f.resize(3, 3);
    f << 0, 1, 2, 0, 2, 3, 0, 2, 4;
    CHECK_THROWS_AS(triangle_dual(EigenTriMesh(v, f), {}), InputError);
}

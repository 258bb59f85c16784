#include "support/catch.hpp"

#include <pavior/block/block_mesh.hpp>
#include <pavior/core/error.hpp>

#include <set>

using pavior::BlockMesh;
using pavior::BlockNode;
using pavior::ErrorCode;
using pavior::HexCorners;
using pavior::Index;
using pavior::InputError;
using pavior::make_block_mesh;

namespace {

/// The midpoint subdivision of m[0] x m[1] x m[2] boxes: nodes of a lattice of twice as many, sorted by dimension.
struct Lattice {
    std::vector<BlockNode> nodes;
    std::vector<HexCorners> hexes;
    std::array<Index, 3> m{};
    std::vector<Index> id;

    explicit Lattice(std::array<Index, 3> boxes) : m(boxes) {
        id.resize((2 * m[0] + 1) * (2 * m[1] + 1) * (2 * m[2] + 1));
        std::array<Index, 4> count{};
        for (int d = 0; d < 4; ++d) {
            each([&](std::array<Index, 3> x) {
                if (dimension(x) == d) {
                    id[index(x)] = static_cast<Index>(nodes.size());
                    nodes.push_back({static_cast<std::uint8_t>(d), count[static_cast<std::size_t>(d)]++, {}});
                }
            });
        }
        each([&](std::array<Index, 3> x) {
            if (dimension(x) == 0) {
                add_corners(x);
            }
        });
    }

    static int dimension(std::array<Index, 3> x) { return static_cast<int>(x[0] % 2 + x[1] % 2 + x[2] % 2); }
    [[nodiscard]] std::size_t index(std::array<Index, 3> x) const {
        return (std::size_t{x[2]} * (2 * m[1] + 1) + x[1]) * (2 * m[0] + 1) + x[0];
    }
    template <class F>
    void each(const F& f) const {
        for (Index k = 0; k <= 2 * m[2]; ++k) {
            for (Index j = 0; j <= 2 * m[1]; ++j) {
                for (Index i = 0; i <= 2 * m[0]; ++i) {
                    f(std::array<Index, 3>{i, j, k});
                }
            }
        }
    }
    void add_corners(std::array<Index, 3> v) {
        for (int code = 0; code < 8; ++code) {
            std::array<int, 3> d{code & 1 ? -1 : 1, code & 2 ? -1 : 1, code & 4 ? -1 : 1};
            std::array<std::size_t, 3> axes{0, 1, 2};
            if (d[0] * d[1] * d[2] < 0) {
                std::swap(axes[0], axes[1]);  // keeps it positive
            }
            const auto at = [&](int a, int b, int c) {
                std::array<Index, 3> x = v;
                const std::array<int, 3> steps{a, b, c};
                for (std::size_t k = 0; k < 3; ++k) {
                    x[axes[k]] = static_cast<Index>(static_cast<int>(x[axes[k]]) + steps[k] * d[axes[k]]);
                }
                return x;
            };
            const auto far = at(1, 1, 1);
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
                inside = inside && far[k] <= 2 * m[k];
            }
            if (inside) {
                hexes.push_back({id[index(at(0, 0, 0))], id[index(at(1, 0, 0))], id[index(at(1, 1, 0))],
                                 id[index(at(0, 1, 0))], id[index(at(0, 0, 1))], id[index(at(1, 0, 1))],
                                 id[index(at(1, 1, 1))], id[index(at(0, 1, 1))]});
            }
        }
    }
};

}  // namespace

TEST_CASE("tables of edges and faces agree", "[block_mesh]") {
    for (std::size_t f = 0; f < 6; ++f) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& edge = pavior::hex_edges[static_cast<std::size_t>(pavior::hex_face_edges[f][k])];
            const std::set<int> ends{pavior::hex_faces[f][k], pavior::hex_faces[f][(k + 1) % 4]};
            CHECK(std::set<int>{edge[0], edge[1]} == ends);
        }
    }
}

TEST_CASE("one box makes eight blocks and six sheets", "[block_mesh]") {
    Lattice lattice({1, 1, 1});
    const BlockMesh mesh = make_block_mesh(lattice.nodes, lattice.hexes);
    CHECK(mesh.hexes.size() == 8);
    CHECK(mesh.nodes.size() == 27);
    CHECK(mesh.edges.size() == 54);
    CHECK(mesh.quads.size() == 36);
    CHECK(mesh.sheet_count == 6);
    CHECK(mesh.first == std::array<Index, 5>{0, 8, 20, 26, 27});
    CHECK(mesh.node(2, 3) == 23);
    std::vector<int> edges_of_sheet(6, 0);
    for (const Index s : mesh.sheets) {
        ++edges_of_sheet[s];
    }
    CHECK(edges_of_sheet == std::vector<int>(6, 9));
}

TEST_CASE("counts of a lattice of boxes", "[block_mesh]") {
    const auto m =
        GENERATE(std::array<Index, 3>{2, 1, 1}, std::array<Index, 3>{3, 2, 1}, std::array<Index, 3>{2, 3, 4});
    Lattice lattice(m);
    const BlockMesh mesh = make_block_mesh(lattice.nodes, lattice.hexes);
    const auto [a, b, c] = std::array<std::size_t, 3>{2 * m[0], 2 * m[1], 2 * m[2]};
    CHECK(mesh.hexes.size() == a * b * c);
    CHECK(mesh.edges.size() == a * (b + 1) * (c + 1) + b * (a + 1) * (c + 1) + c * (a + 1) * (b + 1));
    CHECK(mesh.quads.size() == (a + 1) * b * c + (b + 1) * a * c + (c + 1) * a * b);
    CHECK(mesh.sheet_count == a + b + c);
    std::size_t boundary = 0;
    for (Index q = 0; q < mesh.quads.size(); ++q) {
        boundary += mesh.boundary_quad(q) ? 1 : 0;
    }
    CHECK(boundary == 2 * (a * b + b * c + c * a));
}

TEST_CASE("edges, quads and blocks know what they lie in", "[block_mesh]") {
    Lattice lattice({2, 1, 1});
    const BlockMesh mesh = make_block_mesh(lattice.nodes, lattice.hexes);
    for (Index e = 0; e < mesh.edges.size(); ++e) {
        const auto [low, high] = mesh.edges[e];
        CHECK(mesh.nodes[low].dimension + 1 == mesh.nodes[high].dimension);
        CHECK(mesh.edge_origin(e) == high);
    }
    for (Index q = 0; q < mesh.quads.size(); ++q) {
        const auto& c = mesh.quads[q];
        CHECK(mesh.nodes[c[0]].dimension + 2 == mesh.nodes[c[2]].dimension);
        CHECK(mesh.nodes[c[0]].dimension + 1 == mesh.nodes[c[1]].dimension);
        CHECK(mesh.quad_origin(q) == c[2]);
    }
    for (Index h = 0; h < mesh.hexes.size(); ++h) {
        CHECK(mesh.nodes[mesh.hex_origin(h)].dimension == 3);
        for (std::size_t e = 0; e < 12; ++e) {
            const auto& local = pavior::hex_edges[e];
            CHECK(mesh.edges[mesh.hex_edges[h][e]] ==
                  std::array<Index, 2>{mesh.hexes[h][static_cast<std::size_t>(local[0])],
                                       mesh.hexes[h][static_cast<std::size_t>(local[1])]});
        }
        const auto sheets = mesh.hex_sheets(h);
        for (std::size_t e = 0; e < 12; ++e) {
            CHECK(mesh.sheets[mesh.hex_edges[h][e]] == sheets[e / 4]);
        }
        for (std::size_t f = 0; f < 6; ++f) {
            const auto& hexes = mesh.quad_hexes[mesh.hex_quads[h][f]];
            CHECK((hexes[0] == h || hexes[1] == h));
        }
    }
}

TEST_CASE("blocks that make no sense are refused", "[block_mesh]") {
    const auto code = [](const Lattice& lattice) {
        try {
            static_cast<void>(make_block_mesh(lattice.nodes, lattice.hexes));
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::empty_input;
    };
    Lattice lattice({1, 1, 1});
    CHECK(code(lattice) == ErrorCode::empty_input);
    std::swap(lattice.nodes[0], lattice.nodes[20]);
    CHECK(code(lattice) == ErrorCode::bad_index);
    lattice = Lattice({1, 1, 1});
    std::swap(lattice.hexes[0][0], lattice.hexes[0][6]);
    CHECK(code(lattice) == ErrorCode::bad_index);
    lattice = Lattice({1, 1, 1});
    lattice.hexes[0][5] = 1000;
    CHECK(code(lattice) == ErrorCode::bad_index);
    lattice = Lattice({1, 1, 1});
    lattice.hexes.push_back(lattice.hexes[0]);
    lattice.hexes.push_back(lattice.hexes[0]);
    CHECK(code(lattice) == ErrorCode::invalid_dual);
    CHECK(make_block_mesh({}, {}).hexes.empty());
}

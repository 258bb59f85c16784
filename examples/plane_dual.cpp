// Local dual contributions in the plane: an L of triangles, cut behind its re-entrant corner, becomes quadrilateral
// blocks. Prints the counts; with a file name as argument also draws contributions and blocks as SVG.
#include <pavior/contributions/triangle_dual.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

namespace {

using pavior::Contribution;
using pavior::Index;
using pavior::Vec3;

constexpr Index cells = 6;  // a side of the square that the L is cut from

bool in_l(Index i, Index j) { return i < cells / 2 || j < cells / 2; }

/// An L of uneven triangles, and the cuts that go on from its re-entrant corner along both of its sides.
std::pair<pavior::TriMesh, pavior::TriangleMarks> l_shape() {
    pavior::TriMesh mesh;
    std::map<std::pair<Index, Index>, Index> ids;
    const auto node = [&](Index i, Index j) {
        const auto [at, added] = ids.try_emplace({i, j}, static_cast<Index>(mesh.nodes.size()));
        if (added) {
            const bool inner = i % (cells / 2) != 0 && j % (cells / 2) != 0;
            mesh.nodes.emplace_back(i + (inner ? 0.3 * std::sin(3.0 * i + j) : 0.0),
                                    j + (inner ? 0.3 * std::cos(2.0 * i - j) : 0.0), 0.0);
        }
        return at->second;
    };
    for (Index j = 0; j < cells; ++j) {
        for (Index i = 0; i < cells; ++i) {
            if (in_l(i, j)) {
                const std::array<Index, 4> c{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
                const Index shift = (i + j) % 2;
                mesh.triangles.push_back({c[0], c[1], c[2 + shift]});
                mesh.triangles.push_back({c[shift], c[2], c[3]});
            }
        }
    }
    pavior::TriangleMarks marks{pavior::corner_nodes(mesh), {}};
    for (Index i = 0; i < cells / 2; ++i) {
        marks.layers.push_back({node(i, cells / 2), node(i + 1, cells / 2)});
        marks.layers.push_back({node(cells / 2, i), node(cells / 2, i + 1)});
    }
    for (const auto& [i, j] : {std::pair{0U, cells / 2}, std::pair{cells / 2, 0U}}) {
        marks.vertices.push_back(node(i, j));
    }
    return {std::move(mesh), std::move(marks)};
}

/// Lines in the picture: 60 units a cell, upside down.
class Picture {
public:
    void line(const Vec3& a, const Vec3& b, const char* colour, double width) {
        text_ << "<line x1='" << x(a) << "' y1='" << y(a) << "' x2='" << x(b) << "' y2='" << y(b) << "' stroke='"
              << colour << "' stroke-width='" << width << "' stroke-linecap='round'/>\n";
    }
    void shift(double by) { shift_ += by; }
    [[nodiscard]] std::string text() const {
        return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 820 400'>\n<rect width='820' height='400' "
               "fill='white'/>\n" +
               text_.str() + "</svg>\n";
    }

private:
    [[nodiscard]] long x(const Vec3& p) const { return std::lround(20 + 60 * p.x() + shift_); }
    [[nodiscard]] static long y(const Vec3& p) { return std::lround(380 - 60 * p.y()); }

    std::ostringstream text_;
    double shift_ = 0;
};

/// The triangles, and in each its contributions: orange hard, cyan soft.
void draw_contributions(const pavior::TriMesh& mesh, const pavior::TriangleDual& dual, Picture& picture) {
    constexpr double mu = 0.2;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.nodes[mesh.triangles[t][k % 3]]; };
        const auto inner = [&](std::size_t k) {
            return Vec3((1 - 2 * mu) * corner(k) + mu * (corner(k + 1) + corner(k + 2)));
        };
        for (std::size_t k = 0; k < 3; ++k) {
            picture.line(corner(k), corner(k + 1), "#c8c8c8", 1);
        }
        const auto draw = [&](std::size_t candidate, const Vec3& a, const Vec3& b) {
            const Contribution kind = dual.contributions[t][candidate];
            if (kind != Contribution::none) {
                picture.line(a, b, kind == Contribution::hard ? "#e07b00" : "#00a0c0", 3);
            }
        };
        for (std::size_t k = 0; k < 3; ++k) {
            draw(k, inner(k + 1), inner(k + 2));
            for (std::size_t s = 0; s < 2; ++s) {
                const Vec3& at = corner(k + 1 + s);
                draw(3 + 2 * k + s, inner(k + 1 + s), Vec3((1 - mu) * at + mu * corner(k + 2 - s)));
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const auto [mesh, marks] = l_shape();
    const pavior::TriangleDual dual = pavior::triangle_dual(mesh, marks);
    const pavior::QuadMesh quads = pavior::block_quads(mesh, dual);
    std::printf("%zu triangles, %zu cuts: %zu blocks over %zu nodes, %zu irregular, %s\n", mesh.triangles.size(),
                marks.layers.size(), quads.quads.size(), quads.nodes.size(), dual.irregular,
                pavior::verify_quads(quads).ok() ? "conforming" : "not conforming");
    if (argc > 1) {
        Picture picture;
        draw_contributions(mesh, dual, picture);
        picture.shift(420);
        for (const auto& quad : quads.quads) {
            for (std::size_t k = 0; k < 4; ++k) {
                picture.line(quads.nodes[quad[k]], quads.nodes[quad[(k + 1) % 4]], "#305080", 2);
            }
        }
        std::ofstream(argv[1]) << picture.text();
    }
    return 0;
}

#pragma once
// Random orthogonal solids: unions of cells of a grid with random spacings, their surfaces, and the number of blocks
// that sheets which run through the whole solid make of them, counted on the grid.

#include <pavior/mesh/tagged_mesh.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace pavior::test {

/// Doubles from a std::mt19937 that are the same with every library (the distributions of std are not).
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
    }
    int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }

private:
    std::mt19937 engine_;
};

[[nodiscard]] inline Eigen::Matrix3d random_rotation(Random& random) {
    Eigen::Vector4d q(1, 1, 1, 1);
    do {
        for (int k = 0; k < 4; ++k) {
            q[k] = random(-1, 1);
        }
    } while (q.norm() > 1 || q.norm() < 0.1);
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

/// Cells of a grid: filled[x + nx (y + ny z)].
struct VoxelSolid {
    std::array<int, 3> size{1, 1, 1};
    std::vector<char> filled;
    std::array<std::vector<double>, 3> lines;  ///< size + 1 coordinates each

    [[nodiscard]] bool at(int x, int y, int z) const {
        return x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2] &&
               filled[static_cast<std::size_t>(x + size[0] * (y + size[1] * z))] != 0;
    }
    [[nodiscard]] bool at(std::array<int, 3> c) const { return at(c[0], c[1], c[2]); }
    [[nodiscard]] Vec3 point(std::array<int, 3> g) const {
        return {lines[0][static_cast<std::size_t>(g[0])], lines[1][static_cast<std::size_t>(g[1])],
                lines[2][static_cast<std::size_t>(g[2])]};
    }
};

namespace detail {

/// The eight cells round a grid point, bit x + 2 y + 4 z, 1 for those further along.
[[nodiscard]] inline unsigned octants(const VoxelSolid& s, std::array<int, 3> g) {
    unsigned bits = 0;
    for (int k = 0; k < 8; ++k) {
        const bool in = s.at(g[0] - 1 + (k & 1), g[1] - 1 + ((k >> 1) & 1), g[2] - 1 + ((k >> 2) & 1));
        bits |= in ? 1U << k : 0U;
    }
    return bits;
}

[[nodiscard]] inline bool connected(unsigned bits) {
    if (bits == 0) {
        return true;
    }
    unsigned seen = bits & (~bits + 1);
    for (int pass = 0; pass < 8; ++pass) {
        for (unsigned k = 0; k < 8; ++k) {
            for (const unsigned d : {1U, 2U, 4U}) {
                if ((seen >> k & 1U) != 0 && (bits >> (k ^ d) & 1U) != 0) {
                    seen |= 1U << (k ^ d);
                }
            }
        }
    }
    return seen == bits;
}

/// Face-connected, and the surface is a manifold.
[[nodiscard]] inline bool acceptable(const VoxelSolid& s) {
    for (int z = 0; z <= s.size[2]; ++z) {
        for (int y = 0; y <= s.size[1]; ++y) {
            for (int x = 0; x <= s.size[0]; ++x) {
                const unsigned bits = octants(s, {x, y, z});
                if (!connected(bits) || !connected(~bits & 255U)) {
                    return false;
                }
            }
        }
    }
    std::vector<std::array<int, 3>> found;
    std::vector<char> seen(s.filled.size(), 0);
    std::size_t count = 0;
    for (int i = 0; i < static_cast<int>(s.filled.size()); ++i) {
        if (s.filled[static_cast<std::size_t>(i)] != 0) {
            if (count++ == 0) {
                found.push_back({i % s.size[0], i / s.size[0] % s.size[1], i / s.size[0] / s.size[1]});
                seen[static_cast<std::size_t>(i)] = 1;
            }
        }
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (const int step : {-1, 1}) {
                std::array<int, 3> c = found[i];
                c[k] += step;
                const auto id = static_cast<std::size_t>(c[0] + s.size[0] * (c[1] + s.size[1] * c[2]));
                if (s.at(c) && seen[id] == 0) {
                    seen[id] = 1;
                    found.push_back(c);
                }
            }
        }
    }
    return count > 0 && found.size() == count;
}

}  // namespace detail

/// A random union of up to \p most cells a direction, two at least in two of them; connected, its surface a manifold.
[[nodiscard]] inline VoxelSolid random_voxels(Random& random, int most = 4) {
    VoxelSolid s;
    do {
        for (int& n : s.size) {
            n = 1 + random.below(most);
        }
        const double density = random(0.35, 0.95);
        s.filled.resize(static_cast<std::size_t>(s.size[0] * s.size[1] * s.size[2]));
        for (char& cell : s.filled) {
            cell = random(0, 1) < density ? 1 : 0;
        }
    } while (!detail::acceptable(s));
    for (std::size_t k = 0; k < 3; ++k) {
        s.lines[k] = {0.0};
        for (int i = 0; i < s.size[k]; ++i) {
            s.lines[k].push_back(s.lines[k].back() + random(0.4, 1.6));
        }
    }
    return s;
}

/// Its surface, two triangles a cell face, along alternating diagonals; tag = 6 directions. With coarse, nodes inside
/// flat parts and the lines of the grid stay.
[[nodiscard]] inline TaggedSurface voxel_surface(const VoxelSolid& s) {
    TaggedSurface out;
    std::map<std::array<int, 3>, Index> ids;
    const auto id = [&](std::array<int, 3> g) {
        const auto [at, fresh] = ids.try_emplace(g, static_cast<Index>(out.mesh.nodes.size()));
        if (fresh) {
            out.mesh.nodes.push_back(s.point(g));
        }
        return at->second;
    };
    for (int i = 0; i < static_cast<int>(s.filled.size()); ++i) {
        const std::array<int, 3> c{i % s.size[0], i / s.size[0] % s.size[1], i / s.size[0] / s.size[1]};
        for (std::size_t k = 0; s.at(c) && k < 3; ++k) {
            for (const int side : {0, 1}) {
                std::array<int, 3> next = c;
                next[k] += side == 1 ? 1 : -1;
                if (s.at(next)) {
                    continue;
                }
                std::array<Index, 4> q{};
                for (std::size_t n = 0; n < 4; ++n) {
                    std::array<int, 3> g = c;
                    g[k] += side;
                    g[(k + 1) % 3] += n == 1 || n == 2 ? 1 : 0;
                    g[(k + 2) % 3] += n >= 2 ? 1 : 0;
                    q[side == 1 ? n : 3 - n] = id(g);
                }
                const auto tag = static_cast<std::int32_t>(2 * k) + side;
                out.mesh.triangles.push_back({q[0], q[1], q[2]});
                out.mesh.triangles.push_back({q[0], q[2], q[3]});
                out.face_tags.insert(out.face_tags.end(), {tag, tag});
            }
        }
    }
    return out;
}

/// Blocks and block nodes.
struct BlockCount {
    std::size_t blocks = 0;
    std::size_t nodes = 0;

    friend bool operator==(const BlockCount&, const BlockCount&) = default;
};

/// Counts, on the grid alone, what sheets make that continue every face of the solid past its re-entrant edges until
/// they meet its surface.
class VoxelCounter {
public:
    explicit VoxelCounter(const VoxelSolid& s) : s_(s) {}

    [[nodiscard]] BlockCount count() {
        mark_sheets();
        return {corners(), vertices() + chains() + patches() + cells()};
    }

private:
    using Cell = std::array<int, 3>;
    /// Grid face: lowest point and normal direction; edge: lowest point and direction.
    using Key = std::pair<Cell, std::size_t>;

    static Cell shifted(Cell c, std::size_t k, int by) {
        c[k] += by;
        return c;
    }
    /// Cells on the low and high side of a face.
    [[nodiscard]] std::array<bool, 2> sides(const Key& f) const {
        return {s_.at(shifted(f.first, f.second, -1)), s_.at(f.first)};
    }
    [[nodiscard]] bool inner(const Key& f) const { return sides(f)[0] && sides(f)[1]; }
    [[nodiscard]] bool border(const Key& f) const { return sides(f)[0] != sides(f)[1]; }
    /// The four faces round an edge.
    [[nodiscard]] static std::array<Key, 4> faces_round(const Key& e) {
        const std::size_t a = (e.second + 1) % 3;
        const std::size_t b = (e.second + 2) % 3;
        return {Key{e.first, b}, Key{e.first, a}, Key{shifted(e.first, a, -1), b}, Key{shifted(e.first, b, -1), a}};
    }
    [[nodiscard]] static std::array<Key, 4> edges_of(const Key& f) {
        const std::size_t a = (f.second + 1) % 3;
        const std::size_t b = (f.second + 2) % 3;
        return {Key{f.first, a}, Key{f.first, b}, Key{shifted(f.first, a, 1), b}, Key{shifted(f.first, b, 1), a}};
    }
    [[nodiscard]] static std::array<Key, 6> edges_at(const Cell& g) {
        return {Key{g, 0},
                Key{g, 1},
                Key{g, 2},
                Key{shifted(g, 0, -1), 0},
                Key{shifted(g, 1, -1), 1},
                Key{shifted(g, 2, -1), 2}};
    }
    template <class Visit>
    void each_point(const Visit& visit) const {
        for (int z = 0; z <= s_.size[2]; ++z) {
            for (int y = 0; y <= s_.size[1]; ++y) {
                for (int x = 0; x <= s_.size[0]; ++x) {
                    visit(Cell{x, y, z});
                }
            }
        }
    }
    [[nodiscard]] bool layer(const Key& f) const { return border(f) || marked_.count(f) != 0; }

    void mark_sheets() {
        std::vector<Key> front;
        each_point([&](const Cell& g) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto round = faces_round({g, k});
                const auto borders = std::count_if(round.begin(), round.end(), [&](const Key& f) { return border(f); });
                const auto inners = std::count_if(round.begin(), round.end(), [&](const Key& f) { return inner(f); });
                for (const Key& f : round) {
                    if (borders == 2 && inners == 2 && inner(f) && marked_.insert(f).second) {
                        front.push_back(f);
                    }
                }
            }
        });
        while (!front.empty()) {
            const Key f = front.back();
            front.pop_back();
            for (const Key& e : edges_of(f)) {
                const auto round = faces_round(e);
                if (!std::all_of(round.begin(), round.end(), [&](const Key& g) { return inner(g); })) {
                    continue;
                }
                for (const Key& g : round) {
                    if (g.second == f.second && marked_.insert(g).second) {
                        front.push_back(g);
                    }
                }
            }
        }
    }

    /// 0: no chain. Edges with three or more layers, or where two of them meet at a right angle.
    [[nodiscard]] bool stack(const Key& e) const {
        const auto f = faces_round(e);
        std::array<bool, 4> l{};
        for (std::size_t k = 0; k < 4; ++k) {
            l[k] = layer(f[k]);
        }
        const auto n = std::count(l.begin(), l.end(), true);
        return n >= 3 || (n == 2 && !(l[0] && l[2]) && !(l[1] && l[3]));
    }
    [[nodiscard]] std::size_t stacks_at(const Cell& g) const {
        const auto edges = edges_at(g);
        return static_cast<std::size_t>(
            std::count_if(edges.begin(), edges.end(), [&](const Key& e) { return stack(e); }));
    }
    [[nodiscard]] bool vertex(const Cell& g) const { return stacks_at(g) >= 3; }

    [[nodiscard]] std::size_t vertices() const {
        std::size_t n = 0;
        each_point([&](const Cell& g) { n += vertex(g) ? 1 : 0; });
        return n;
    }
    /// Each chain has two ends.
    [[nodiscard]] std::size_t chains() const {
        std::size_t ends = 0;
        each_point([&](const Cell& g) { ends += vertex(g) ? stacks_at(g) : 0; });
        return ends / 2;
    }

    /// Number of classes of the keys of `all` under `joined`.
    template <class T, class Join>
    static std::size_t classes(const std::set<T>& all, const Join& neighbours) {
        std::set<T> left = all;
        std::size_t n = 0;
        while (!left.empty()) {
            ++n;
            std::vector<T> todo{*left.begin()};
            left.erase(left.begin());
            while (!todo.empty()) {
                const T item = todo.back();
                todo.pop_back();
                for (const T& other : neighbours(item)) {
                    if (left.erase(other) != 0) {
                        todo.push_back(other);
                    }
                }
            }
        }
        return n;
    }
    [[nodiscard]] std::size_t patches() const {
        std::set<Key> all;
        each_point([&](const Cell& g) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (layer({g, k})) {
                    all.insert({g, k});
                }
            }
        });
        return classes(all, [&](const Key& f) {
            std::vector<Key> others;
            for (const Key& e : edges_of(f)) {
                for (const Key& g : faces_round(e)) {
                    if (!stack(e) && g != f && layer(g)) {
                        others.push_back(g);
                    }
                }
            }
            return others;
        });
    }
    [[nodiscard]] std::set<Cell> filled() const {
        std::set<Cell> all;
        each_point([&](const Cell& g) {
            if (s_.at(g)) {
                all.insert(g);
            }
        });
        return all;
    }
    [[nodiscard]] std::size_t cells() const {
        return classes(filled(), [&](const Cell& c) { return open_neighbours(c, {}); });
    }
    /// Cells across faces that are no layers; only those round `at` if it is given (non-empty).
    [[nodiscard]] std::vector<Cell> open_neighbours(const Cell& c, const std::vector<Cell>& at) const {
        std::vector<Cell> others;
        for (std::size_t k = 0; k < 3; ++k) {
            for (const int side : {0, 1}) {
                const Key f{shifted(c, k, side), k};
                const Cell other = shifted(c, k, side == 1 ? 1 : -1);
                const bool round = at.empty() || std::find(at.begin(), at.end(), other) != at.end();
                if (round && inner(f) && !layer(f)) {
                    others.push_back(other);
                }
            }
        }
        return others;
    }
    /// Corners of cells: classes of the grid cells round each vertex.
    [[nodiscard]] std::size_t corners() const {
        std::size_t n = 0;
        each_point([&](const Cell& g) {
            if (!vertex(g)) {
                return;
            }
            std::vector<Cell> round;
            for (int k = 0; k < 8; ++k) {
                const Cell c{g[0] - (k & 1), g[1] - ((k >> 1) & 1), g[2] - ((k >> 2) & 1)};
                if (s_.at(c)) {
                    round.push_back(c);
                }
            }
            n += classes(std::set<Cell>(round.begin(), round.end()),
                         [&](const Cell& c) { return open_neighbours(c, round); });
        });
        return n;
    }

    const VoxelSolid& s_;
    std::set<Key> marked_;
};

[[nodiscard]] inline BlockCount count_blocks(const VoxelSolid& s) { return VoxelCounter(s).count(); }

}  // namespace pavior::test

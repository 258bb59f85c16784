#pragma once
// Boundary representations of solids made of boxes: neighbouring coplanar squares become one face, with holes.
#include "support/test_brep.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace pavior::test {

/// Boxes of a rectilinear lattice, each of solid 1, 2, ... or 0 for none.
struct Voxels {
    std::array<int, 3> size{};
    std::vector<int> label = std::vector<int>(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                                              static_cast<std::size_t>(size[2]));
    std::array<std::vector<double>, 3> at{};  ///< coordinates of the lattice planes

    explicit Voxels(int i, int j, int k) : size{i, j, k} {
        for (std::size_t a = 0; a < 3; ++a) {
            for (int p = 0; p <= size[a]; ++p) {
                at[a].push_back(p);
            }
        }
    }
    [[nodiscard]] std::size_t index(const std::array<int, 3>& c) const {
        return static_cast<std::size_t>((c[2] * size[1] + c[1]) * size[0] + c[0]);
    }
    [[nodiscard]] int operator()(const std::array<int, 3>& c) const {
        for (std::size_t a = 0; a < 3; ++a) {
            if (c[a] < 0 || c[a] >= size[a]) {
                return 0;
            }
        }
        return label[index(c)];
    }
    void fill(std::array<int, 3> low, std::array<int, 3> high, int with) {
        for (int k = low[2]; k < high[2]; ++k) {
            for (int j = low[1]; j < high[1]; ++j) {
                for (int i = low[0]; i < high[0]; ++i) {
                    label[index({i, j, k})] = with;
                }
            }
        }
    }
    [[nodiscard]] double volume(int of) const {
        double sum = 0.0;
        for (int k = 0; k < size[2]; ++k) {
            for (int j = 0; j < size[1]; ++j) {
                for (int i = 0; i < size[0]; ++i) {
                    const std::array<std::size_t, 3> c{static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                                                       static_cast<std::size_t>(k)};
                    sum += (*this)({i, j, k}) != of
                               ? 0.0
                               : (at[0][c[0] + 1] - at[0][c[0]]) * (at[1][c[1] + 1] - at[1][c[1]]) *
                                     (at[2][c[2] + 1] - at[2][c[2]]);
                }
            }
        }
        return sum;
    }
};

/// Makes the model. `place` moves points of the lattice (by default to the planes); flipped: the normals of every third
/// face point inwards.
class VoxelBrep {
public:
    using Point = std::array<int, 3>;
    using Place = std::function<Vec3(const Vec3&)>;

    VoxelBrep(const Voxels& voxels, bool flipped = false, Place place = {})
        : voxels_(voxels), flipped_(flipped), place_(std::move(place)) {
        collect_squares();
        sound_ = manifold();
        if (sound_) {
            unite_squares();
            make_faces();
        }
    }

    /// False where a solid touches itself in an edge or a vertex, or a face does: there is no model then.
    [[nodiscard]] bool sound() const { return sound_; }
    [[nodiscard]] const TestBrep& brep() const { return brep_; }
    [[nodiscard]] std::vector<SolidId> solids() const {
        std::vector<SolidId> result;
        for (std::size_t s = 0; s < brep_.solid_count(); ++s) {
            result.push_back(SolidId{static_cast<std::int32_t>(s)});
        }
        return result;
    }

private:
    struct Square {
        Point low;
        std::size_t axis;
        int below, above;  ///< labels
    };
    using Segment = std::pair<Point, std::size_t>;  ///< low end, axis

    static Point step(Point p, std::size_t a, int by) {
        p[a] += by;
        return p;
    }
    [[nodiscard]] Vec3 point(const Point& p) const {
        Vec3 x;
        for (std::size_t a = 0; a < 3; ++a) {
            x[static_cast<Eigen::Index>(a)] = voxels_.at[a][static_cast<std::size_t>(p[a])];
        }
        return place_ ? place_(x) : x;
    }
    template <class F>
    void for_each_point(F&& f) const {
        for (int k = 0; k <= voxels_.size[2]; ++k) {
            for (int j = 0; j <= voxels_.size[1]; ++j) {
                for (int i = 0; i <= voxels_.size[0]; ++i) {
                    f(Point{i, j, k});
                }
            }
        }
    }

    void collect_squares() {
        for_each_point([&](const Point& p) {
            for (std::size_t a = 0; a < 3; ++a) {
                const int below = voxels_(step(p, a, -1)), above = voxels_(p);
                if (below != above) {
                    for (std::size_t side = 1; side < 3; ++side) {
                        const std::size_t b = (a + side) % 3, along = (a + 3 - side) % 3;
                        at_segment_[{p, along}].push_back(squares_.size());
                        at_segment_[{step(p, b, 1), along}].push_back(squares_.size());
                    }
                    squares_.push_back({p, a, below, above});
                }
            }
        });
    }

    /// Round every lattice point the cells of each label are connected by faces, and so are the others.
    [[nodiscard]] bool manifold() const {
        bool result = true;
        for_each_point([&](const Point& p) {
            std::array<int, 8> label{};
            std::set<int> labels;
            for (std::size_t c = 0; c < 8; ++c) {
                label[c] = voxels_({p[0] - 1 + static_cast<int>(c & 1U), p[1] - 1 + static_cast<int>(c >> 1 & 1U),
                                    p[2] - 1 + static_cast<int>(c >> 2)});
                labels.insert(label[c]);
            }
            for (const int l : labels) {
                for (const bool inside : {true, false}) {
                    std::array<std::size_t, 8> group{0, 1, 2, 3, 4, 5, 6, 7};
                    for (int pass = 0; pass < 8; ++pass) {
                        for (std::size_t c = 0; c < 8; ++c) {
                            for (const std::size_t d : {c ^ 1U, c ^ 2U, c ^ 4U}) {
                                if ((label[c] == l) == inside && (label[d] == l) == inside) {
                                    group[c] = std::min(group[c], group[d]);
                                }
                            }
                        }
                    }
                    std::set<std::size_t> groups;
                    for (std::size_t c = 0; c < 8; ++c) {
                        if ((label[c] == l) == inside) {
                            groups.insert(group[c]);
                        }
                    }
                    result = result && groups.size() <= 1;
                }
            }
        });
        return result;
    }

    [[nodiscard]] bool smooth(const Segment& segment) const {
        const std::vector<std::size_t>& around = at_segment_.at(segment);
        const auto key = [&](std::size_t s) {
            return std::tuple(squares_[s].axis, squares_[s].below, squares_[s].above);
        };
        return around.size() == 2 && key(around[0]) == key(around[1]);
    }

    void unite_squares() {
        component_.resize(squares_.size());
        std::iota(component_.begin(), component_.end(), std::size_t{0});
        const std::function<std::size_t(std::size_t)> root = [&](std::size_t s) {
            return component_[s] == s ? s : component_[s] = root(component_[s]);
        };
        for (const auto& [segment, around] : at_segment_) {
            if (smooth(segment)) {
                component_[root(around[1])] = root(around[0]);
            } else {
                for (const int end : {0, 1}) {
                    sharp_[step(segment.first, segment.second, end)].push_back(segment.second);
                }
            }
        }
        for (std::size_t s = 0; s < squares_.size(); ++s) {
            component_[s] = root(s);
        }
    }

    [[nodiscard]] bool is_vertex(const Point& p) const {
        const std::vector<std::size_t>& axes = sharp_.at(p);
        return axes.size() != 2 || axes[0] != axes[1];
    }
    [[nodiscard]] VertexId vertex(const Point& p) {
        const auto [at, fresh] = vertices_.try_emplace(p);
        if (fresh) {
            at->second = brep_.vertex(point(p));
        }
        return at->second;
    }

    /// The sharp segments of a face, counter-clockwise about +axis: from each start to its end.
    [[nodiscard]] std::multimap<Point, Point> outline(const std::vector<std::size_t>& squares) const {
        std::multimap<Point, Point> next;
        for (const std::size_t s : squares) {
            const std::size_t b = (squares_[s].axis + 1) % 3, c = (squares_[s].axis + 2) % 3;
            const Point p = squares_[s].low;
            const std::array<Point, 4> corner{p, step(p, b, 1), step(step(p, b, 1), c, 1), step(p, c, 1)};
            for (std::size_t i = 0; i < 4; ++i) {
                const Point &from = corner[i], &to = corner[(i + 1) % 4];
                if (!smooth({std::min(from, to), i % 2 == 0 ? b : c})) {
                    next.emplace(from, to);
                }
            }
        }
        return next;
    }

    void make_faces() {
        std::map<std::size_t, std::vector<std::size_t>> members;
        for (std::size_t s = 0; s < squares_.size(); ++s) {
            members[component_[s]].push_back(s);
        }
        std::map<int, std::vector<OrientedFace>> faces;
        for (const auto& [first, squares] : members) {
            const Square& square = squares_[first];
            std::multimap<Point, Point> next = outline(squares);
            std::vector<std::pair<double, std::vector<VertexId>>> loops;
            while (!next.empty()) {
                std::vector<Point> loop;
                for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
                    sound_ = sound_ && next.count(at->first) == 1;
                    if (loop.empty()) {
                        loop.push_back(at->first);
                    }
                    loop.push_back(at->second);
                    next.erase(at);
                }
                loop.pop_back();
                loops.push_back(loop_of(loop, square.axis));
            }
            if (!sound_) {
                return;
            }
            std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& c) { return a.first > c.first; });
            const bool up = square.below != 0 ? (++count_ % 3 != 0 || !flipped_) : (++count_ % 3 == 0 && flipped_);
            add_face(square, loops, up, faces);
        }
        for (auto& [label, sides] : faces) {
            brep_.solid(std::move(sides));
        }
    }

    [[nodiscard]] std::pair<double, std::vector<VertexId>> loop_of(const std::vector<Point>& loop, std::size_t axis) {
        const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
        double area = 0.0;
        std::vector<VertexId> result;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point &p = loop[i], &q = loop[(i + 1) % loop.size()];
            area += p[b] * q[c] - p[c] * q[b];
            if (is_vertex(p)) {
                result.push_back(vertex(p));
            }
        }
        return {area, result};
    }

    void add_face(const Square& square, const std::vector<std::pair<double, std::vector<VertexId>>>& loops, bool up,
                  std::map<int, std::vector<OrientedFace>>& faces) {
        std::vector<EdgeLoop> edges;
        for (const auto& [area, vertices] : loops) {
            std::vector<VertexId> v = vertices;
            if (!up) {
                std::reverse(v.begin(), v.end());
            }
            edges.push_back(brep_.polygon(v));
        }
        Vec3 normal = Vec3::Zero();
        const std::vector<VertexId>& outer = loops.front().second;
        for (std::size_t i = 0; i < outer.size(); ++i) {
            normal += brep_.vertex_point(outer[i]).cross(brep_.vertex_point(outer[(i + 1) % outer.size()]));
        }
        const FaceId f = brep_.flat(std::move(edges), up ? normal : Vec3(-normal));
        if (square.below != 0) {
            faces[square.below].push_back({f, up});
        }
        if (square.above != 0) {
            faces[square.above].push_back({f, !up});
        }
    }

    Voxels voxels_;
    bool flipped_;
    Place place_;
    bool sound_ = true;
    int count_ = 0;
    std::vector<Square> squares_;
    std::map<Segment, std::vector<std::size_t>> at_segment_;
    std::vector<std::size_t> component_;
    std::map<Point, std::vector<std::size_t>> sharp_;
    std::map<Point, VertexId> vertices_;
    TestBrep brep_;
};

/// Boxes filled at random with the solids 1 .. solids; random distances between the planes.
inline Voxels random_voxels(std::mt19937& random, int extent, int boxes, int solids) {
    Voxels voxels(extent, extent, extent);
    for (int i = 0; i < boxes; ++i) {
        std::array<int, 3> low{}, high{};
        for (std::size_t a = 0; a < 3; ++a) {
            const int p = static_cast<int>(random() % static_cast<unsigned>(extent + 1));
            const int q = static_cast<int>(random() % static_cast<unsigned>(extent + 1));
            low[a] = std::min({p, q, extent - 1});
            high[a] = std::max(low[a] + 1, std::max(p, q));
        }
        voxels.fill(low, high, i == 0 ? 1 : static_cast<int>(random() % static_cast<unsigned>(solids + 1)));
    }
    for (std::vector<double>& planes : voxels.at) {
        for (std::size_t p = 1; p < planes.size(); ++p) {
            planes[p] = planes[p - 1] + 0.3 + 0.1 * static_cast<double>(random() % 20);
        }
    }
    return voxels;
}

}  // namespace pavior::test

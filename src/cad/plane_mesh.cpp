#include "plane_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace pavior::detail {

namespace {

/// The sign of a sum of products, two numbers each: expansions without rounding.
int sign_of_sum(std::span<const std::array<double, 2>> products) {
    std::vector<double> sum;
    const auto add = [&](double value) {
        for (double& part : sum) {
            const double high = part + value;
            const double back = high - part;
            part = (part - (high - back)) + (value - back);
            value = high;
        }
        sum.push_back(value);
    };
    for (const auto& [a, b] : products) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }
    const auto top = std::find_if(sum.rbegin(), sum.rend(), [](double part) { return part != 0; });
    return top == sum.rend() ? 0 : *top > 0 ? 1 : -1;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of a point on the line through a and b.
bool between(const Vec2& a, const Vec2& b, const Vec2& x) {
    return std::min(a.x(), b.x()) <= x.x() && x.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= x.y() &&
           x.y() <= std::max(a.y(), b.y());
}

bool boxes_apart(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
           std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y());
}

/// Whether the segments have a point in common, other than an end that they share by number.
bool meet(std::span<const Vec2> x, Index a, Index b, Index c, Index d) {
    if (boxes_apart(x[a], x[b], x[c], x[d])) {
        return false;
    }
    if (a == c || a == d || b == c || b == d) {
        const Index own = a == c || a == d ? b : a;
        const Index other = c == a || c == b ? d : c;
        return own != other && turn(x[a], x[b], x[other]) == 0 &&
               (between(x[a], x[b], x[other]) || between(x[c], x[d], x[own]));
    }
    const int ab_c = turn(x[a], x[b], x[c]);
    const int ab_d = turn(x[a], x[b], x[d]);
    const int cd_a = turn(x[c], x[d], x[a]);
    const int cd_b = turn(x[c], x[d], x[b]);
    return (ab_c * ab_d < 0 && cd_a * cd_b < 0) || (ab_c == 0 && between(x[a], x[b], x[c])) ||
           (ab_d == 0 && between(x[a], x[b], x[d])) || (cd_a == 0 && between(x[c], x[d], x[a])) ||
           (cd_b == 0 && between(x[c], x[d], x[b]));
}

/// One ring of all loops: bridges to the holes are run twice.
class Ring {
public:
    Ring(std::span<const Vec2> points, const PointLoops& loops) : x_(points), ring_(loops.front()) {
        std::vector<std::vector<Index>> holes(loops.begin() + 1, loops.end());
        const auto left = [&](Index a, Index b) {
            return x_[a].x() != x_[b].x() ? x_[a].x() < x_[b].x() : x_[a].y() < x_[b].y();
        };
        for (auto& hole : holes) {
            std::rotate(hole.begin(), std::min_element(hole.begin(), hole.end(), left), hole.end());
        }
        std::sort(holes.begin(), holes.end(), [&](const auto& a, const auto& b) { return left(a[0], b[0]); });
        for (std::size_t h = 0; h < holes.size() && !failed_; ++h) {
            failed_ = !join(holes, h);
        }
    }

    /// Cuts ears off; empty if there is no way to.
    [[nodiscard]] std::vector<TriCorners> ears() const {
        std::vector<TriCorners> triangles;
        std::vector<std::size_t> next(ring_.size());
        std::vector<std::size_t> last(ring_.size());
        for (std::size_t i = 0; i < ring_.size(); ++i) {
            next[i] = (i + 1) % ring_.size();
            last[next[i]] = i;
        }
        std::size_t at = 0;
        std::size_t left = failed_ ? 0 : ring_.size();
        for (std::size_t misses = 0; left >= 3 && misses <= left;) {
            const std::size_t before = last[at];
            const std::size_t after = next[at];
            if (is_ear(before, at, after, next)) {
                triangles.push_back({ring_[before], ring_[at], ring_[after]});
                next[before] = after;
                last[after] = before;
                --left;
                misses = 0;
                at = next[after];  // not the next corner: no fans
            } else {
                ++misses;
                at = after;
            }
        }
        return left == 2 ? triangles : std::vector<TriCorners>();
    }

private:
    bool join(const std::vector<std::vector<Index>>& holes, std::size_t h) {
        const Index start = holes[h][0];
        std::vector<std::size_t> order(ring_.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        const auto distance = [&](std::size_t i) { return (x_[ring_[i]] - x_[start]).squaredNorm(); };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
        for (const std::size_t at : order) {
            if (sees(at, start) && free(ring_, ring_[at], start) &&
                std::all_of(holes.begin() + static_cast<std::ptrdiff_t>(h), holes.end(),
                            [&](const auto& hole) { return free(hole, ring_[at], start); })) {
                std::vector<Index> bridge(holes[h]);
                bridge.push_back(start);
                bridge.push_back(ring_[at]);
                ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(at) + 1, bridge.begin(), bridge.end());
                return true;
            }
        }
        return false;
    }

    /// Whether the way to a point starts inside the corner at position \p at of the ring.
    [[nodiscard]] bool sees(std::size_t at, Index point) const {
        const Vec2& before = x_[ring_[(at + ring_.size() - 1) % ring_.size()]];
        const Vec2& here = x_[ring_[at]];
        const Vec2& after = x_[ring_[(at + 1) % ring_.size()]];
        const bool left_of_after = turn(here, after, x_[point]) > 0;
        const bool left_of_before = turn(before, here, x_[point]) > 0;
        return turn(before, here, after) >= 0 ? left_of_after && left_of_before : left_of_after || left_of_before;
    }

    [[nodiscard]] bool free(const std::vector<Index>& loop, Index a, Index b) const {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (meet(x_, a, b, loop[i], loop[(i + 1) % loop.size()])) {
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] bool is_ear(std::size_t before, std::size_t at, std::size_t after,
                              const std::vector<std::size_t>& next) const {
        const std::array<Index, 3> c{ring_[before], ring_[at], ring_[after]};
        if (turn(x_[c[0]], x_[c[1]], x_[c[2]]) <= 0) {
            return false;
        }
        const Vec2 low = x_[c[0]].cwiseMin(x_[c[1]]).cwiseMin(x_[c[2]]);
        const Vec2 high = x_[c[0]].cwiseMax(x_[c[1]]).cwiseMax(x_[c[2]]);
        for (std::size_t i = next[after]; i != before; i = next[i]) {
            const Vec2& x = x_[ring_[i]];
            if ((x.array() < low.array()).any() || (x.array() > high.array()).any() ||
                std::find(c.begin(), c.end(), ring_[i]) != c.end()) {
                continue;
            }
            if (turn(x_[c[0]], x_[c[1]], x) >= 0 && turn(x_[c[1]], x_[c[2]], x) >= 0 &&
                turn(x_[c[2]], x_[c[0]], x) >= 0) {
                return false;
            }
        }
        return true;
    }

    std::span<const Vec2> x_;
    std::vector<Index> ring_;
    bool failed_ = false;
};

std::uint64_t edge_key(Index a, Index b) {
    return (std::uint64_t{std::min(a, b)} << 32U) | std::uint64_t{std::max(a, b)};
}

}  // namespace

int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double left = (a.x() - c.x()) * (b.y() - c.y());
    const double right = (a.y() - c.y()) * (b.x() - c.x());
    const double area = left - right;
    if (std::abs(area) > 4e-16 * (std::abs(left) + std::abs(right))) {
        return area > 0 ? 1 : -1;
    }
    const std::array<std::array<double, 2>, 6> products{
        {{a.x(), b.y()}, {-a.y(), b.x()}, {b.x(), c.y()}, {-b.y(), c.x()}, {c.x(), a.y()}, {-c.y(), a.x()}}};
    return sign_of_sum(products);
}

std::vector<Index> crossing_edges(std::span<const Vec2> points, const PointLoops& loops) {
    std::vector<std::array<Index, 2>> edges;
    for (const auto& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
        }
    }
    std::vector<Index> crossing;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            if (meet(points, edges[i][0], edges[i][1], edges[j][0], edges[j][1])) {
                crossing.push_back(edges[i][0]);
                crossing.push_back(edges[j][0]);
            }
        }
    }
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    return crossing;
}

std::optional<PlaneMesh> PlaneMesh::of(std::vector<Vec2> points, const PointLoops& loops) {
    PlaneMesh mesh;
    mesh.points_ = std::move(points);
    for (const TriCorners& corners : Ring(mesh.points_, loops).ears()) {
        mesh.triangles_.push_back({corners});
    }
    if (mesh.triangles_.empty()) {
        return std::nullopt;
    }
    if (!mesh.connect()) {
        return std::nullopt;
    }
    std::vector<std::pair<Index, std::size_t>> edges;
    for (Index t = 0; t < mesh.triangles_.size(); ++t) {
        for (const std::size_t k : {0U, 1U, 2U}) {
            edges.emplace_back(t, k);
        }
    }
    mesh.settle(std::move(edges));
    return mesh;
}

std::vector<TriCorners> PlaneMesh::triangles() const {
    std::vector<TriCorners> corners(triangles_.size());
    std::transform(triangles_.begin(), triangles_.end(), corners.begin(), [](const Triangle& t) { return t.nodes; });
    return corners;
}

bool PlaneMesh::connect() {
    std::map<std::pair<Index, Index>, std::pair<Index, std::size_t>> sides;
    for (Index t = 0; t < triangles_.size(); ++t) {
        for (const std::size_t k : {0U, 1U, 2U}) {
            const auto& nodes = triangles_[t].nodes;
            if (!sides.emplace(std::pair(nodes[(k + 1) % 3], nodes[(k + 2) % 3]), std::pair(t, k)).second) {
                return false;
            }
        }
    }
    for (const auto& [edge, side] : sides) {
        const auto other = sides.find({edge.second, edge.first});
        if (other != sides.end()) {
            triangles_[side.first].across[side.second] = other->second.first;
        }
    }
    return true;
}

std::size_t PlaneMesh::side_of(Index triangle, Index neighbour) const {
    const auto& across = triangles_[triangle].across;
    return static_cast<std::size_t>(std::find(across.begin(), across.end(), neighbour) - across.begin());
}

bool PlaneMesh::wants_flip(Index triangle, std::size_t side) const {
    const Index other = triangles_[triangle].across[side];
    if (other == no_index) {
        return false;
    }
    const auto& nodes = triangles_[triangle].nodes;
    const Vec2& p = points_[nodes[side]];
    const Vec2& a = points_[nodes[(side + 1) % 3]];
    const Vec2& b = points_[nodes[(side + 2) % 3]];
    const Vec2& q = points_[triangles_[other].nodes[side_of(other, triangle)]];
    // Sine of the sum of the angles opposite the edge: negative beyond pi.
    const double sine = cross(a - p, b - p) * (a - q).dot(b - q) + (a - p).dot(b - p) * cross(b - q, a - q);
    const double scale = (a - p).norm() * (b - p).norm() * (a - q).norm() * (b - q).norm();
    return sine < -1e-9 * scale && turn(p, a, q) > 0 && turn(p, q, b) > 0;
}

void PlaneMesh::replace(Index triangle, Index old_neighbour, Index neighbour) {
    if (triangle != no_index) {
        triangles_[triangle].across[side_of(triangle, old_neighbour)] = neighbour;
    }
}

void PlaneMesh::flip(Index triangle, std::size_t side) {
    const Index other = triangles_[triangle].across[side];
    const std::size_t back = side_of(other, triangle);
    const Triangle one = triangles_[triangle];
    const Triangle two = triangles_[other];
    const Index p = one.nodes[side];
    const Index a = one.nodes[(side + 1) % 3];
    const Index b = one.nodes[(side + 2) % 3];
    const Index q = two.nodes[back];
    const Index beyond_pa = one.across[(side + 2) % 3];
    const Index beyond_bp = one.across[(side + 1) % 3];
    const Index beyond_qb = two.across[(back + 2) % 3];  // two is (q, b, a)
    const Index beyond_aq = two.across[(back + 1) % 3];
    triangles_[triangle] = {{p, a, q}, {beyond_aq, other, beyond_pa}};
    triangles_[other] = {{p, q, b}, {beyond_qb, beyond_bp, triangle}};
    replace(beyond_aq, other, triangle);
    replace(beyond_bp, triangle, other);
}

std::vector<Index> PlaneMesh::settle(std::vector<std::pair<Index, std::size_t>> edges) {
    std::vector<Index> touched;
    const std::size_t most = 100 * (triangles_.size() + edges.size()) + 10000;  // rounding could turn in circles
    for (std::size_t flips = 0; !edges.empty() && flips < most;) {
        const auto [triangle, side] = edges.back();
        edges.pop_back();
        if (!wants_flip(triangle, side)) {
            continue;
        }
        const Index other = triangles_[triangle].across[side];
        flip(triangle, side);
        ++flips;
        for (const Index t : {triangle, other}) {
            touched.push_back(t);
            for (const std::size_t k : {0U, 1U, 2U}) {
                if (triangles_[t].across[k] != triangle && triangles_[t].across[k] != other) {
                    edges.emplace_back(t, k);
                }
            }
        }
    }
    return touched;
}

std::vector<Index> PlaneMesh::halve(Index triangle, std::size_t side) {
    const Index other = triangles_[triangle].across[side];
    const std::size_t back = side_of(other, triangle);
    const Triangle one = triangles_[triangle];
    const Triangle two = triangles_[other];
    const Index p = one.nodes[side];
    const Index a = one.nodes[(side + 1) % 3];
    const Index b = one.nodes[(side + 2) % 3];
    const Index q = two.nodes[back];
    const Vec2 middle = 0.5 * (points_[a] + points_[b]);
    for (const auto& [x, y] : {std::pair(p, a), {b, p}, {q, b}, {a, q}}) {
        if (turn(points_[x], points_[y], middle) <= 0) {
            return {};
        }
    }
    const auto m = static_cast<Index>(points_.size());
    points_.push_back(middle);
    const auto third = static_cast<Index>(triangles_.size());
    const auto fourth = static_cast<Index>(third + 1);
    const Index beyond_pa = one.across[(side + 2) % 3];
    const Index beyond_bp = one.across[(side + 1) % 3];
    const Index beyond_qb = two.across[(back + 2) % 3];
    const Index beyond_aq = two.across[(back + 1) % 3];
    triangles_[triangle] = {{m, p, a}, {beyond_pa, fourth, third}};
    triangles_[other] = {{m, q, b}, {beyond_qb, third, fourth}};
    triangles_.push_back({{m, b, p}, {beyond_bp, triangle, other}});
    triangles_.push_back({{m, a, q}, {beyond_aq, other, triangle}});
    replace(beyond_bp, triangle, third);
    replace(beyond_aq, other, fourth);
    std::vector<Index> touched{triangle, other, third, fourth};
    std::vector<std::pair<Index, std::size_t>> edges;
    for (const Index t : touched) {
        edges.emplace_back(t, 0);
    }
    const std::vector<Index> more = settle(std::move(edges));
    touched.insert(touched.end(), more.begin(), more.end());
    return touched;
}

bool PlaneMesh::refine(const Badness& badness, const Added& added, std::size_t most) {
    struct Entry {
        double badness;
        Index a, b, triangle;
        bool operator<(const Entry& other) const {
            return std::tuple(badness, other.a, other.b) < std::tuple(other.badness, a, b);
        }
    };
    std::unordered_map<std::uint64_t, double> known;
    std::priority_queue<Entry> queue;
    const auto consider = [&](Index t) {
        for (const std::size_t k : {0U, 1U, 2U}) {
            if (triangles_[t].across[k] == no_index) {
                continue;
            }
            const Index a = triangles_[t].nodes[(k + 1) % 3];
            const Index b = triangles_[t].nodes[(k + 2) % 3];
            const auto [found, is_new] = known.try_emplace(edge_key(a, b), 0);
            if (is_new) {
                found->second = badness(std::min(a, b), std::max(a, b));
            }
            if (found->second > 1) {
                queue.push({found->second, std::min(a, b), std::max(a, b), t});
            }
        }
    };
    for (Index t = 0; t < triangles_.size(); ++t) {
        consider(t);
    }
    for (std::size_t count = 0; !queue.empty();) {
        const Entry entry = queue.top();
        queue.pop();
        const auto& nodes = triangles_[entry.triangle].nodes;
        std::size_t side = 3;
        for (const std::size_t k : {0U, 1U, 2U}) {
            const auto [low, high] = std::minmax(nodes[(k + 1) % 3], nodes[(k + 2) % 3]);
            side = low == entry.a && high == entry.b ? k : side;
        }
        if (side == 3 || triangles_[entry.triangle].across[side] == no_index) {
            continue;  // the edge is no more, or seen from another triangle
        }
        if (count == most) {
            return false;
        }
        const std::vector<Index> touched = halve(entry.triangle, side);
        if (touched.empty()) {
            known[edge_key(entry.a, entry.b)] = 0;
            continue;
        }
        ++count;
        added(static_cast<Index>(points_.size() - 1), entry.a, entry.b);
        for (const Index t : touched) {
            consider(t);
        }
    }
    return true;
}

}  // namespace pavior::detail

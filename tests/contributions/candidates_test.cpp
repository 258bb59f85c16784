#include "support/catch.hpp"

#include <pavior/contributions/candidates.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>

using namespace pavior;

namespace {
// "2134": the point near node v_2, on v_2 and the other nodes named.
std::size_t point(const std::string& name) {
    std::vector<std::size_t> nodes;
    for (const char digit : name) {
        nodes.push_back(static_cast<std::size_t>(digit - '1'));
    }
    if (nodes.size() == 2) {
        return edge_point(static_cast<std::size_t>(tet_edge_between[nodes[0]][nodes[1]]), nodes[0]);
    }
    return nodes.size() == 3 ? face_point(6 - nodes[0] - nodes[1] - nodes[2], nodes[0]) : inner_point(nodes[0]);
}

// Points of a candidate as a cycle from its smallest, in the smaller sense.
std::vector<std::size_t> cycle(std::vector<std::size_t> points) {
    std::vector<std::size_t> best;
    for (int sense = 0; sense < 2; ++sense) {
        std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
        best = best.empty() ? points : std::min(best, points);
        std::reverse(points.begin(), points.end());
    }
    return best;
}

std::vector<std::size_t> points_of(const Candidate& c) { return cycle({c.points.begin(), c.points.begin() + c.size}); }
std::vector<std::size_t> named(const std::vector<std::string>& names) {
    std::vector<std::size_t> points;
    std::transform(names.begin(), names.end(), std::back_inserter(points), point);
    return cycle(points);
}
}  // namespace

TEST_CASE("the list of appendix C, misprints mended") {
    const auto face = [](std::size_t f) { return points_of(tet_candidates[face_candidates + f]); };
    CHECK(face(0) == named({"2134", "3124", "4123"}));
    CHECK(face(1) == named({"4123", "3124", "1234"}));
    CHECK(face(2) == named({"1234", "2134", "4123"}));
    CHECK(face(3) == named({"3124", "2134", "1234"}));
    const auto edge = [](std::size_t i, std::size_t j, std::size_t missing) {
        const auto e = static_cast<std::size_t>(tet_edge_between[i - 1][j - 1]);
        const std::size_t s = edge_faces[e][0] == missing - 1 ? 0 : 1;
        CHECK(edge_faces[e][s] == missing - 1);
        return points_of(tet_candidates[edge_candidates + 2 * e + s]);
    };
    CHECK(edge(1, 2, 4) == named({"213", "123", "1234", "2134"}));
    CHECK(edge(1, 2, 3) == named({"124", "214", "2134", "1234"}));
    CHECK(edge(1, 3, 2) == named({"314", "134", "1234", "3124"}));
    CHECK(edge(1, 3, 4) == named({"123", "312", "3124", "1234"}));
    CHECK(edge(1, 4, 2) == named({"134", "413", "4123", "1234"}));
    CHECK(edge(1, 4, 3) == named({"412", "124", "1234", "4123"}));
    CHECK(edge(2, 3, 1) == named({"234", "324", "3124", "2134"}));
    CHECK(edge(2, 3, 4) == named({"312", "213", "2134", "3124"}));
    CHECK(edge(2, 4, 1) == named({"423", "234", "2134", "4123"}));
    CHECK(edge(2, 4, 3) == named({"214", "412", "4123", "2134"}));
    CHECK(edge(3, 4, 1) == named({"324", "423", "4123", "3124"}));
    CHECK(edge(3, 4, 2) == named({"413", "314", "3124", "4123"}));
    const auto vertex = [](std::size_t v, std::size_t i, std::size_t j) {
        const auto e = static_cast<std::size_t>(tet_edge_between[i - 1][j - 1]);
        const Candidate& c = tet_candidates[vertex_candidates + 2 * e + (v == i ? 0 : 1)];
        CHECK(c.entity == v - 1);
        CHECK(c.other == e);
        return points_of(c);
    };
    CHECK(vertex(1, 1, 2) == named({"12", "123", "1234", "124"}));
    CHECK(vertex(1, 1, 3) == named({"13", "123", "1234", "134"}));
    CHECK(vertex(1, 1, 4) == named({"14", "124", "1234", "134"}));
    CHECK(vertex(2, 1, 2) == named({"21", "213", "2134", "214"}));
    CHECK(vertex(2, 2, 3) == named({"23", "213", "2134", "234"}));
    CHECK(vertex(2, 2, 4) == named({"24", "214", "2134", "234"}));
    CHECK(vertex(3, 1, 3) == named({"31", "312", "3124", "314"}));
    CHECK(vertex(3, 2, 3) == named({"32", "312", "3124", "324"}));
    CHECK(vertex(3, 3, 4) == named({"34", "314", "3124", "324"}));
    CHECK(vertex(4, 1, 4) == named({"41", "412", "4123", "413"}));
    CHECK(vertex(4, 2, 4) == named({"42", "412", "4123", "423"}));
    CHECK(vertex(4, 3, 4) == named({"43", "413", "4123", "423"}));
}

TEST_CASE("points lie on the planes that the candidates lie on") {
    constexpr double mu = 0.2;
    for (const Candidate& c : tet_candidates) {
        int planes = 0;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            planes += std::all_of(c.points.begin(), c.points.begin() + c.size,
                                  [&](std::size_t p) { return candidate_point(p, mu)[axis] == mu; })
                          ? 1
                          : 0;
        }
        CHECK(planes == 1);
    }
    std::set<std::array<double, 4>> all;
    for (std::size_t p = 0; p < 28; ++p) {
        const auto lambda = candidate_point(p, mu);
        CHECK(lambda[0] + lambda[1] + lambda[2] + lambda[3] == Approx(1.0));
        all.insert(lambda);
    }
    CHECK(all.size() == 28);
}

TEST_CASE("inner edges of the arrangement: each side of a candidate is shared as planes in general position do") {
    std::map<std::pair<std::size_t, std::size_t>, int> sides;
    for (const Candidate& c : tet_candidates) {
        for (std::size_t k = 0; k < c.size; ++k) {
            const std::size_t a = c.points[k];
            const std::size_t b = c.points[(k + 1) % c.size];
            ++sides[{std::min(a, b), std::max(a, b)}];
        }
    }
    int inside = 0;
    for (const auto& [ends, uses] : sides) {
        const bool on_face = ends.first < 12 && ends.second < 24;
        CHECK((ends.second >= 24 ? uses == 4 : uses == 1));
        inside += ends.second >= 24 ? 1 : 0;
        CHECK(on_face == (ends.second < 24 && ends.first < 12));
    }
    CHECK(inside == 18);  // 6 between inner points, 12 from inner to face points
}

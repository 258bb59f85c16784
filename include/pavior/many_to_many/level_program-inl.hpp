#pragma once

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/level_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<std::vector<Index>> curves_of_edges(const PlaneArrangement& plane) {
    std::vector<std::vector<Index>> result(plane.edges.size());
    for (Index c = 0; c < plane.routes.size(); ++c) {
        for (const OrientedPlaneEdge& use : plane.routes[c]) {
            if (result[use.edge].empty() || result[use.edge].back() != c) {
                result[use.edge].push_back(c);
            }
        }
    }
    return result;
}

PAVIOR_INLINE LevelClasses::LevelClasses(const ExtrudedBody& body)
    : body_(body), sets_(cap_count() + curve_count() + body.vertices.size()) {
    for (std::size_t c = 0; c < cap_count(); ++c) {
        for (const Index curve : body.caps[c].curves) {
            join(c, cap_count() + curve);
        }
    }
    for (std::size_t c = 0; c < curve_count(); ++c) {
        for (const Index v : body.curves[c].vertices) {
            join(cap_count() + c, cap_count() + curve_count() + v);
        }
    }
}

PAVIOR_INLINE std::pair<std::string, int> LevelClasses::name(std::size_t item) const {
    if (item < cap_count()) {
        const int tag = body_.caps[item].tag;
        return {"face " + std::to_string(tag), tag};
    }
    item -= cap_count();
    if (item < curve_count()) {
        const ExtrudedCurve& curve = body_.curves[item];
        return curve.face != 0 ? std::pair("a line on face " + std::to_string(curve.face), curve.face)
                               : std::pair("edge " + std::to_string(curve.tag), 0);
    }
    return {"a vertex", 0};
}

PAVIOR_INLINE std::vector<Index> plane_vertices(const ExtrudedBody& body, const PlaneArrangement& plane) {
    std::vector<Index> result(body.vertices.size(), no_index);
    for (std::size_t c = 0; c < body.curves.size(); ++c) {
        for (std::size_t k = 0; k < 2; ++k) {
            result[body.curves[c].vertices[k]] = plane.ends[c][k];
        }
    }
    return result;
}

PAVIOR_INLINE std::vector<LevelGap> level_gaps(const std::vector<LevelColumn>& columns, LevelClasses& classes,
                                               const LevelTolerance& tolerance) {
    for (const LevelColumn& column : columns) {
        for (std::size_t i = 0; i + 1 < column.items.size(); ++i) {
            if (column.items[i + 1].height - column.items[i].height <= tolerance.height) {
                classes.join(column.items[i].item, column.items[i + 1].item);
            }
        }
    }
    std::map<std::pair<std::size_t, std::size_t>, LevelGap> gaps;
    for (const LevelColumn& column : columns) {
        for (std::size_t i = 0; i + 1 < column.items.size(); ++i) {
            const ColumnItem& low = column.items[i];
            const ColumnItem& high = column.items[i + 1];
            const double length = high.height - low.height;
            const std::pair key(classes.find(low.item), classes.find(high.item));
            const bool same = key.first == key.second && !column.inside;
            if (length > (same ? tolerance.slack : tolerance.height)) {
                LevelGap& gap =
                    gaps.try_emplace(key, LevelGap{key.first, key.second, low.item, high.item}).first->second;
                gap.length += length;
                ++gap.columns;
            }
        }
    }
    std::vector<LevelGap> result;
    for (const auto& [key, gap] : gaps) {
        result.push_back(gap);
    }
    return result;
}

PAVIOR_INLINE LevelSystem::LevelSystem(const LevelClasses& classes, const std::vector<LevelGap>& gaps, double size)
    : classes_(classes), gaps_(gaps), tree_(classes.size()) {
    for (const LevelGap& gap : gaps) {
        system_.edges.push_back({std::max(1e-3, gap.length / gap.columns / size), 1});
        check(gap);
    }
    std::vector<bool> done(classes.size(), false);
    std::multimap<std::size_t, std::size_t> at;
    for (std::size_t g = 0; g < gaps.size(); ++g) {
        at.emplace(gaps[g].low, g);
        at.emplace(gaps[g].high, g);
    }
    std::vector<bool> in_tree(gaps.size(), false);
    for (const LevelGap& root : gaps) {
        if (!done[root.low]) {
            grow(root.low, at, done, in_tree);
        }
    }
    for (std::size_t g = 0; g < gaps.size(); ++g) {
        if (!in_tree[g]) {
            add_cycle(g);
        }
    }
}

PAVIOR_INLINE std::vector<int> LevelSystem::levels(const std::vector<int>& numbers) const {
    std::vector<int> result(classes_.size(), 0);
    std::map<std::size_t, int> lowest;
    for (const std::size_t c : order_) {
        for (const auto& [gap, sign] : tree_[c].path) {
            result[c] += sign * numbers[gap];
        }
        int& low = lowest.try_emplace(tree_[c].root, 0).first->second;
        low = std::min(low, result[c]);
    }
    for (const std::size_t c : order_) {
        result[c] -= lowest[tree_[c].root];
    }
    return result;
}

PAVIOR_INLINE void LevelSystem::check(const LevelGap& gap) const {
    if (gap.low == gap.high) {
        const auto [low, low_tag] = classes_.name(gap.low_item);
        const auto [high, high_tag] = classes_.name(gap.high_item);
        Error::Ids ids;
        for (const int tag : {low_tag, high_tag}) {
            if (tag != 0) {
                ids.push_back(tag);
            }
        }
        throw UnmeshableError(ErrorCode::not_sweepable,
                              low + " and " + high +
                                  " lie above each other, yet slanted faces or edges lead from one to the other "
                                  "without a side between them",
                              ids);
    }
}

PAVIOR_INLINE void LevelSystem::grow(std::size_t root, const std::multimap<std::size_t, std::size_t>& at,
                                     std::vector<bool>& done, std::vector<bool>& in_tree) {
    std::vector<std::size_t> queue{root};
    done[root] = true;
    tree_[root].root = root;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::size_t c = queue[i];
        order_.push_back(c);
        for (auto [g, end] = at.equal_range(c); g != end; ++g) {
            const LevelGap& gap = gaps_[g->second];
            const std::size_t other = gap.low == c ? gap.high : gap.low;
            if (!done[other]) {
                done[other] = true;
                in_tree[g->second] = true;
                tree_[other] = tree_[c];
                tree_[other].path.emplace_back(g->second, gap.low == c ? 1 : -1);
                queue.push_back(other);
            }
        }
    }
}

PAVIOR_INLINE std::map<std::size_t, int> LevelSystem::layers_between(std::size_t low, std::size_t high) const {
    std::map<std::size_t, int> terms;
    for (const auto& [gap, sign] : tree_[low].path) {
        terms[gap] -= sign;
    }
    for (const auto& [gap, sign] : tree_[high].path) {
        terms[gap] += sign;
    }
    return terms;
}

PAVIOR_INLINE void LevelSystem::add_step(std::size_t low, std::size_t high, const std::string& text, int face) {
    IntervalRule rule;
    for (const auto& [gap, sign] : layers_between(low, high)) {
        if (sign != 0) {
            rule.terms.emplace_back(gap, sign);
        }
    }
    if (rule.terms.empty() || tree_[low].root != tree_[high].root) {
        throw UnmeshableError(ErrorCode::not_sweepable, text + ", yet there is no height between these here", {face});
    }
    rule.value = 1;
    rule.text = text;
    rule.faces.push_back(face);
    system_.rules.push_back(std::move(rule));
}

PAVIOR_INLINE void add_steps(const ExtrudedBody& body, const LevelClasses& classes, LevelSystem& system) {
    const std::size_t first = classes.cap_count() + classes.curve_count();
    std::set<std::pair<std::size_t, std::size_t>> known;
    for (const ExtrudedStep& step : body.steps) {
        const std::pair key(classes.find(first + step.low), classes.find(first + step.high));
        if (known.insert(key).second) {
            system.add_step(
                key.first, key.second,
                "the mesh given on face " + std::to_string(step.tag) + " has one layer between neighbouring nodes",
                step.tag);
        }
    }
}

PAVIOR_INLINE void LevelSystem::add_cycle(std::size_t g) {
    std::map<std::size_t, int> terms = layers_between(gaps_[g].high, gaps_[g].low);
    ++terms[g];
    IntervalRule rule;
    std::set<int> faces;
    rule.text = "layers between";
    for (const auto& [gap, sign] : terms) {
        if (sign != 0) {
            rule.terms.emplace_back(gap, sign);
            const auto [low, low_tag] = classes_.name(gaps_[gap].low_item);
            const auto [high, high_tag] = classes_.name(gaps_[gap].high_item);
            rule.text += (rule.terms.size() > 1 ? ", " : " ") + low + " and " + high;
            faces.insert({low_tag, high_tag});
        }
    }
    rule.text += " add up";
    faces.erase(0);
    rule.faces.assign(faces.begin(), faces.end());
    system_.rules.push_back(std::move(rule));
}

}  // namespace detail

}  // namespace pavior

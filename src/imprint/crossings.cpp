#include "crossings.hpp"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <limits>
#include <map>

namespace pavior::detail {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SegmentTraits = CGAL::Arr_segment_traits_2<Kernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, Index>;
using Arrangement = CGAL::Arrangement_2<Traits>;

Kernel::Point_2 to_point(const Vec2& x) { return {x.x(), x.y()}; }

/// The arrangement of segments, each with its number.
Arrangement arrange(const Routes& routes, const std::vector<std::pair<Index, Index>>& segments) {
    std::vector<Traits::Curve_2> curves;
    for (std::size_t s = 0; s < segments.size(); ++s) {
        curves.emplace_back(SegmentTraits::Curve_2(to_point(routes.points[segments[s].first]),
                                                   to_point(routes.points[segments[s].second])),
                            static_cast<Index>(s));
    }
    Arrangement arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());
    return arrangement;
}

/// Numbers of vertices: those of the points they were made from; crossings are added to the points.
class Numbers {
public:
    Numbers(Routes& routes, const std::vector<std::pair<Index, Index>>& segments) : routes_(routes) {
        for (const auto& [a, b] : segments) {
            number_.emplace(key(routes.points[a]), a);
            number_.emplace(key(routes.points[b]), b);
        }
    }
    Index operator()(const Kernel::Point_2& point) {
        const Vec2 x(CGAL::to_double(point.x()), CGAL::to_double(point.y()));
        const auto [at, added] = number_.emplace(key(x), static_cast<Index>(routes_.points.size()));
        if (added) {
            routes_.points.push_back(x);
            routes_.corner.push_back(0);
        }
        return at->second;
    }

private:
    static std::pair<double, double> key(const Vec2& x) { return {x.x(), x.y()}; }

    Routes& routes_;
    std::map<std::pair<double, double>, Index> number_;
};

/// The closed walk from a halfedge.
template <class Circulator>
Walk walk(Circulator first, Numbers& number) {
    Walk result;
    Circulator at = first;
    do {
        result.push_back(number(at->source()->point()));
    } while (++at != first);
    std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace

bool cut_crossings(Routes& routes) {
    const std::vector<std::pair<Index, Index>> segments = routes.segments();
    const std::size_t before = routes.points.size();
    const Arrangement arrangement = arrange(routes, segments);
    Numbers number(routes, segments);
    std::vector<std::vector<Index>> chains(segments.size());
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
        const Index a = number(e->source()->point());
        const Index b = number(e->target()->point());
        for (auto s = e->curve().data().begin(); s != e->curve().data().end(); ++s) {
            chains[*s].push_back(a);
            chains[*s].push_back(b);
        }
    }
    bool changed = routes.points.size() > before;
    for (std::size_t s = 0; s < segments.size(); ++s) {
        std::vector<Index>& chain = chains[s];
        const Vec2 from = routes.points[segments[s].first];
        const Vec2 along = routes.points[segments[s].second] - from;
        const auto place = [&](Index i) {
            return i == segments[s].first    ? -std::numeric_limits<double>::infinity()
                   : i == segments[s].second ? std::numeric_limits<double>::infinity()
                                             : (routes.points[i] - from).dot(along);
        };
        std::sort(chain.begin(), chain.end(), [&](Index i, Index j) {
            const double at_i = place(i);
            const double at_j = place(j);
            return at_i < at_j || (at_i == at_j && i < j);
        });
        chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
        changed = changed || chain.size() > 2;
    }
    routes.refine(segments, chains);
    routes.tidy();
    return changed;
}

std::vector<std::vector<Walk>> faces(const Routes& routes) {
    Routes copy = routes;
    const std::vector<std::pair<Index, Index>> segments = routes.segments();
    const Arrangement arrangement = arrange(routes, segments);
    Numbers number(copy, segments);
    std::vector<std::vector<Walk>> result;
    for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
        if (face->is_unbounded()) {
            continue;
        }
        std::vector<Walk> walks{walk(face->outer_ccb(), number)};
        for (auto hole = face->holes_begin(); hole != face->holes_end(); ++hole) {
            walks.push_back(walk(*hole, number));
        }
        std::sort(walks.begin() + 1, walks.end());
        result.push_back(std::move(walks));
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace pavior::detail

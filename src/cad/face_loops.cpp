#include "face_loops.hpp"

#include <pavior/core/index.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace pavior::detail {

namespace {

/// End 2c is the first sample of curve c, end 2c + 1 the last.
struct Ends {
    const std::vector<BoundaryCurve>& curves;
    Vec2 scale;

    [[nodiscard]] std::size_t vertex(std::size_t end) const { return curves[end / 2].vertices[end % 2]; }
    [[nodiscard]] const Vec2& uv(std::size_t end) const {
        return end % 2 == 0 ? curves[end / 2].uv.front() : curves[end / 2].uv.back();
    }
    [[nodiscard]] double distance(std::size_t a, std::size_t b) const {
        return (uv(a) - uv(b)).cwiseQuotient(scale).norm();
    }
    /// How far apart in the list: neighbours in a wire are listed one after the other.
    [[nodiscard]] std::size_t list_distance(std::size_t a, std::size_t b) const {
        const std::size_t gap = a / 2 > b / 2 ? a / 2 - b / 2 : b / 2 - a / 2;
        return std::min(gap, curves.size() - gap);
    }
};

/// The end that each end is glued to, nearest pairs first; no_position where none is left.
std::vector<std::size_t> pair_ends(const Ends& ends) {
    const std::size_t count = 2 * ends.curves.size();
    std::vector<std::tuple<long long, std::size_t, std::size_t, std::size_t>> candidates;
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            if (ends.vertex(a) == ends.vertex(b)) {
                const double rounded = std::min(ends.distance(a, b) * 1e5, 1e15);
                candidates.emplace_back(std::llround(rounded), ends.list_distance(a, b), a, b);
            }
        }
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::size_t> partner(count, no_position);
    for (const auto& [distance, gap, a, b] : candidates) {
        if (partner[a] == no_position && partner[b] == no_position) {
            partner[a] = b;
            partner[b] = a;
        }
    }
    return partner;
}

CurveLoop reversed(const CurveLoop& loop) {
    CurveLoop result(loop.rbegin(), loop.rend());
    for (DirectedCurve& piece : result) {
        piece.forward = !piece.forward;
    }
    return result;
}

/// Puts the largest loop first, and turns them to the left.
void orient(const std::vector<BoundaryCurve>& curves, std::vector<CurveLoop>& loops) {
    std::vector<double> areas(loops.size());
    std::transform(loops.begin(), loops.end(), areas.begin(),
                   [&](const CurveLoop& loop) { return enclosed_area(curves, loop); });
    const auto largest =
        std::max_element(areas.begin(), areas.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    const auto outer = largest - areas.begin();
    for (std::size_t i = 0; i < loops.size(); ++i) {
        const bool wants_positive = static_cast<std::ptrdiff_t>(i) == outer;
        if ((areas[i] > 0) != wants_positive) {
            loops[i] = reversed(loops[i]);
        }
    }
    std::rotate(loops.begin(), loops.begin() + outer, loops.begin() + outer + 1);
}

}  // namespace

double enclosed_area(const std::vector<BoundaryCurve>& curves, const CurveLoop& loop) {
    const Vec2 origin = curves[loop.front().curve].uv.front();
    double twice = 0;
    Vec2 previous = Vec2::Zero();
    bool started = false;
    Vec2 first = Vec2::Zero();
    const auto visit = [&](const Vec2& uv) {
        const Vec2 point = uv - origin;
        if (started) {
            twice += previous.x() * point.y() - previous.y() * point.x();
        } else {
            first = point;
            started = true;
        }
        previous = point;
    };
    for (const DirectedCurve& piece : loop) {
        const std::vector<Vec2>& uv = curves[piece.curve].uv;
        if (piece.forward) {
            std::for_each(uv.begin(), uv.end(), visit);
        } else {
            std::for_each(uv.rbegin(), uv.rend(), visit);
        }
    }
    return 0.5 * (twice + previous.x() * first.y() - previous.y() * first.x());
}

std::optional<std::vector<CurveLoop>> chain_curves(const std::vector<BoundaryCurve>& curves, const Vec2& scale) {
    constexpr double gap_limit = 0.02;
    const Ends ends{curves, scale};
    const std::vector<std::size_t> partner = pair_ends(ends);
    for (std::size_t end = 0; end < partner.size(); ++end) {
        if (partner[end] == no_position || ends.distance(end, partner[end]) > gap_limit) {
            return std::nullopt;
        }
    }
    std::vector<CurveLoop> loops;
    std::vector<bool> used(curves.size(), false);
    for (std::size_t start = 0; start < curves.size(); ++start) {
        if (used[start]) {
            continue;
        }
        CurveLoop loop;
        for (std::size_t entry = 2 * start; !used[entry / 2]; entry = partner[entry ^ 1U]) {
            used[entry / 2] = true;
            loop.push_back({entry / 2, entry % 2 == 0});
        }
        loops.push_back(std::move(loop));
    }
    if (!loops.empty()) {
        orient(curves, loops);
    }
    return loops;
}

Vec2 interior_point(const std::vector<BoundaryCurve>& curves) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const BoundaryCurve& curve : curves) {
        for (const Vec2& uv : curve.uv) {
            low = std::min(low, uv.y());
            high = std::max(high, uv.y());
        }
    }
    Vec2 best = curves.front().uv.front();
    double width = 0;
    std::vector<double> crossings;
    for (int line = 1; line < 16; ++line) {
        const double v = low + (high - low) * (line + 0.01) / 16.0;
        crossings.clear();
        for (const BoundaryCurve& curve : curves) {
            for (std::size_t i = 0; i + 1 < curve.uv.size(); ++i) {
                const Vec2& a = curve.uv[i];
                const Vec2& b = curve.uv[i + 1];
                if ((a.y() < v) != (b.y() < v)) {
                    crossings.push_back(a.x() + (b.x() - a.x()) * (v - a.y()) / (b.y() - a.y()));
                }
            }
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            if (crossings[i + 1] - crossings[i] > width) {
                width = crossings[i + 1] - crossings[i];
                best = Vec2(0.5 * (crossings[i] + crossings[i + 1]), v);
            }
        }
    }
    return best;
}

}  // namespace pavior::detail

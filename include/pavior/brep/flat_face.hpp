#pragma once
/// \file
/// The loops of a face laid out in a plane: parameters made metric by the mean first fundamental form.

#include <pavior/brep/face_corners.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <Eigen/Cholesky>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Places of the vertices of a face in a plane; distances and angles are roughly those in space (exact for planes).
/// Counter-clockwise is counter-clockwise about the face's own normal.
struct FlatFace {
    std::vector<std::vector<Vec2>> start;  ///< per loop and use: the vertex where the use starts
    std::vector<std::vector<Vec2>> chord;  ///< per loop and use: from its start to its end
};

/// Lays out \p loops of face \p f (in the sense of the face's own loops, the outer one first). Each use is followed in
/// \p pieces steps, none of which may span half a period of the surface.
template <brep B>
[[nodiscard]] FlatFace flat_face(const B& b, FaceId f, std::span<const EdgeLoop> loops, int pieces = 8) {
    const Periods periods = b.face_period(f);
    FlatFace result;
    std::vector<Vec2> outer;
    Eigen::Matrix2d metric = Eigen::Matrix2d::Zero();
    for (const EdgeLoop& loop : loops) {
        std::vector<Vec2> chain;
        for (const OrientedEdge& use : loop) {
            const auto range = b.edge_range(use.edge);
            for (int i = 0; i <= pieces; ++i) {
                const double part = static_cast<double>(use.forward ? i : pieces - i) / pieces;
                const double t = part >= 1.0 ? range[1] : range[0] + part * (range[1] - range[0]);
                chain.push_back(b.edge_on_face(use.edge, t, f, use.forward));
                const auto d = b.face_derivatives(f, chain.back());
                const double mixed = d.first.dot(d.second);
                metric += (Eigen::Matrix2d() << d.first.dot(d.first), mixed, mixed, d.second.dot(d.second)).finished();
            }
        }
        unwrap_chain(chain, periods);
        if (result.start.empty()) {
            outer = chain;
        } else {
            const Vec2 shift = inside_shift(chain.front(), outer, periods);
            for (Vec2& uv : chain) {
                uv += shift;
            }
        }
        std::vector<Vec2> starts, chords;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto step = static_cast<std::size_t>(pieces) + 1;
            starts.push_back(chain[i * step]);
            chords.push_back(chain[i * step + step - 1] - chain[i * step]);
        }
        result.start.push_back(std::move(starts));
        result.chord.push_back(std::move(chords));
    }
    metric += 1e-24 * metric.trace() * Eigen::Matrix2d::Identity();
    const Eigen::LLT<Eigen::Matrix2d> factor(metric / std::max(metric.trace(), 1e-300));
    const Eigen::Matrix2d upper = factor.matrixU();
    double samples = 0.0;
    for (const EdgeLoop& loop : loops) {
        samples += static_cast<double>(loop.size() * (static_cast<std::size_t>(pieces) + 1));
    }
    const Eigen::Matrix2d to_plane = upper * std::sqrt(metric.trace() / samples);
    for (auto* vectors : {&result.start, &result.chord}) {
        for (std::vector<Vec2>& loop : *vectors) {
            for (Vec2& p : loop) {
                p = to_plane * p;
            }
        }
    }
    return result;
}

}  // namespace pavior

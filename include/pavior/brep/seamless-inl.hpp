#pragma once

#include <pavior/brep/seamless.hpp>
#include <pavior/core/index.hpp>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<EdgeLoop> seamless_loops(std::span<const EdgeLoop> loops) {
    std::vector<OrientedEdge> uses;
    std::vector<std::size_t> next;
    std::map<OrientedEdge, std::size_t> at;
    for (const EdgeLoop& loop : loops) {
        const std::size_t first = uses.size();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            at.emplace(loop[i], uses.size());
            uses.push_back(loop[i]);
            next.push_back(first + (i + 1) % loop.size());
        }
    }
    const auto twin = [&](std::size_t i) {
        const auto found = at.find({uses[i].edge, !uses[i].forward});
        return found == at.end() ? no_position : found->second;
    };
    std::vector<char> done(uses.size(), 0);
    std::vector<EdgeLoop> result;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (done[i] != 0 || twin(i) != no_position) {
            continue;
        }
        EdgeLoop loop;
        for (std::size_t h = i; done[h] == 0;) {
            done[h] = 1;
            loop.push_back(uses[h]);
            h = next[h];
            while (twin(h) != no_position) {
                h = next[twin(h)];
            }
        }
        result.push_back(std::move(loop));
    }
    return result;
}

PAVIOR_INLINE SolidBoundary without_seams(const SolidBoundary& solid, std::span<const std::size_t> faces) {
    std::vector<char> seamless(solid.faces.size(), 0);
    for (const std::size_t f : faces) {
        seamless[f] = 1;
    }
    const auto dropped = [&](std::size_t h) {
        const std::size_t f = solid.half_edges[h].face;
        return seamless[f] != 0 && solid.twin_face(h) == f;
    };
    SolidBoundary result{solid.solid, solid.tag, solid.faces, {}};
    std::vector<std::size_t> number(solid.half_edges.size(), no_position);
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
        SolidBoundary::Face& face = result.faces[f];
        face.seam = face.seam && seamless[f] == 0;
        face.loops.clear();
        face.begin = result.half_edges.size();
        for (std::size_t first = solid.faces[f].begin; first < solid.faces[f].end; ++first) {
            if (dropped(first) || number[first] != no_position) {
                continue;
            }
            const std::size_t begin = result.half_edges.size();
            double angle = solid.half_edges[first].angle;
            for (std::size_t h = first; number[h] == no_position;) {
                number[h] = result.half_edges.size();
                result.half_edges.push_back(solid.half_edges[h]);
                result.half_edges.back().angle = angle;
                result.half_edges.back().loop = face.loops.size();
                result.half_edges.back().next = number[h] + 1;
                angle = 0;
                for (h = solid.half_edges[h].next; dropped(h); h = solid.half_edges[solid.half_edges[h].twin].next) {
                    angle += solid.half_edges[h].angle;
                }
                angle += solid.half_edges[h].angle;
            }
            result.half_edges[begin].angle = angle;
            result.half_edges.back().next = begin;
            face.loops.push_back(begin);
        }
        face.end = result.half_edges.size();
    }
    for (SolidBoundary::HalfEdge& h : result.half_edges) {
        h.twin = number[h.twin];
    }
    return result;
}

}  // namespace pavior

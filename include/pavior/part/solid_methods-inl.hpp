#pragma once

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/one_to_one/side_grid.hpp>
#include <pavior/one_to_one/structure_side.hpp>
#include <pavior/part/solid_methods.hpp>
#include <pavior/submap/submap_recognition.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace pavior {

PAVIOR_INLINE std::vector<SolidWays> solid_ways(const AnyModel& b, std::span<const SolidId> solids,
                                                const IntegerSolver& solver, const SubmapOptions& submap) {
    std::vector<SolidWays> result;
    for (const SolidId solid : solids) {
        SolidWays ways{solid, true, recognise_sweeps(b, solid).candidates};
        try {
            (void)recognise_submaps(b, std::span(&solid, 1), submap, solver);
        } catch (const UnmeshableError&) {
            ways.submap = false;
        }
        result.push_back(std::move(ways));
    }
    return result;
}

namespace detail {

/// Chooses sweeps outwards from the faces that are meshed already. A face whose mesh is no grid must be a cap, and
/// hands its mesh on to the other cap.
class MethodChooser {
public:
    MethodChooser(const AnyModel& b, std::span<const SolidWays> ways, BoundaryMesh& given)
        : b_(b), ways_(ways), given_(given), chosen_(ways.size(), no_position) {
        given_.faces.resize(b.face_count());
        for (std::size_t f = 0; f < given_.faces.size(); ++f) {
            if (!given_.faces[f].empty()) {
                fixed_.insert(FaceId{static_cast<std::int32_t>(f)});
            }
        }
    }

    [[nodiscard]] MethodChoice take(bool prefer_submap) {
        PAVIOR_ASSERT(
            std::none_of(ways_.begin(), ways_.end(), [](const SolidWays& w) { return w.only_multi_sweep(); }));
        for (bool grown = true; grown;) {
            grown = false;
            for (std::size_t w = 0; w < ways_.size(); ++w) {
                if (chosen_[w] == no_position && touches_fixed(ways_[w].solid)) {
                    choose(w);
                    grown = true;
                }
            }
        }
        MethodChoice result;
        for (std::size_t w = 0; w < ways_.size(); ++w) {
            const bool free = chosen_[w] == no_position;
            if (chosen_[w] == submapped || (free && ways_[w].submap && (prefer_submap || ways_[w].sweeps.empty()))) {
                result.submaps.push_back(ways_[w].solid);
            } else {
                result.sweeps.push_back(ways_[w].sweeps[free ? 0 : chosen_[w]]);
            }
        }
        return result;
    }

private:
    static constexpr std::size_t submapped = no_position - 1;

    [[nodiscard]] bool fixed(FaceId f) const { return fixed_.contains(f); }

    [[nodiscard]] bool touches_fixed(SolidId solid) const {
        const std::span<const OrientedFace> faces = b_.solid_faces(solid);
        return std::any_of(faces.begin(), faces.end(), [&](const OrientedFace& f) { return fixed(f.face); });
    }

    /// All its fixed faces are meshed already.
    [[nodiscard]] bool given_only(SolidId solid) const {
        const std::span<const OrientedFace> faces = b_.solid_faces(solid);
        return std::none_of(faces.begin(), faces.end(), [&](const OrientedFace& f) {
            return fixed(f.face) && given_.faces[f.face.index()].empty();
        });
    }

    /// The face is meshed with the grid of a linking side.
    [[nodiscard]] bool fits(const LinkingSide& side) {
        const FaceMesh& face = given_.faces[side.face.index()];
        if (face.empty() || !side.rectangle()) {
            return !face.empty() && detail::lattice_nodes(given_, side);
        }
        return face.structured() || structure_side(given_, side, b_.face_period(side.face));
    }

    /// All linking sides that are fixed are grids.
    [[nodiscard]] bool fits(const SweepTopology& sweep) {
        for (const std::vector<LinkingSide>& loop : sweep.loops) {
            for (const LinkingSide& side : loop) {
                if (fixed(side.face) && !fits(side)) {
                    return false;
                }
            }
        }
        return true;
    }

    void choose(std::size_t w) {
        const std::vector<SweepTopology>& sweeps = ways_[w].sweeps;
        for (const bool both_caps : {false, true}) {
            for (std::size_t i = 0; i < sweeps.size() && chosen_[w] == no_position; ++i) {
                if ((both_caps || !fixed(sweeps[i].source) || !fixed(sweeps[i].target)) && fits(sweeps[i])) {
                    chosen_[w] = i;
                }
            }
        }
        if (chosen_[w] == no_position) {
            if (!ways_[w].submap || !given_only(ways_[w].solid)) {
                throw no_fit(ways_[w].solid);
            }
            chosen_[w] = submapped;
            return;
        }
        const SweepTopology& sweep = sweeps[chosen_[w]];
        if (fixed(sweep.source) || fixed(sweep.target)) {
            fixed_.insert(sweep.source);
            fixed_.insert(sweep.target);
        }
    }

    [[nodiscard]] UnmeshableError no_fit(SolidId solid) const {
        std::set<int> faces;
        for (const OrientedFace& f : b_.solid_faces(solid)) {
            if (fixed(f.face)) {
                faces.insert(b_.tag(2, f.face.index()));
            }
        }
        return {ErrorCode::not_sweepable,
                "solid " + std::to_string(b_.tag(3, solid.index())) + " has no sweep that fits its neighbours at " +
                    detail::list(faces, "face", "faces"),
                Error::Ids(faces.begin(), faces.end())};
    }

    const AnyModel& b_;
    std::span<const SolidWays> ways_;
    BoundaryMesh& given_;
    std::vector<std::size_t> chosen_;
    std::set<FaceId> fixed_;  ///< the mesh of the face is, or will be, what another solid makes of it
};

}  // namespace detail

PAVIOR_INLINE MethodChoice choose_methods(const AnyModel& b, std::span<const SolidWays> ways, BoundaryMesh& given,
                                          bool prefer_submap) {
    return detail::MethodChooser(b, ways, given).take(prefer_submap);
}

}  // namespace pavior

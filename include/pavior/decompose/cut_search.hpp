#pragma once
/// \file
/// What best_cuts() is asked, and what it finds.

#include <pavior/decompose/piece_methods.hpp>
#include <pavior/decompose/solid_cut.hpp>

#include <cstddef>
#include <stop_token>
#include <vector>

namespace pavior {

struct CutSearchOptions {
    std::size_t max_cuts = 150;   ///< tries of the cutter, at most
    std::size_t max_idle = 75;    ///< tries of surfaces before pieces are meshed together for the first time, at most
    std::size_t max_meshes = 16;  ///< times that all pieces are meshed together, at most
    std::size_t max_pieces = 24;  ///< of a solid
    double sufficient = 0.2;      ///< nothing more is tried once a mesh has this quality
    CutCosts costs = {};
    std::stop_token stop = {};  ///< ends the search by Stopped
};

/// The best cuts, and how they were found.
struct CutSearch {
    std::vector<SolidCut> cuts;  ///< empty: none were found
    double quality = -1;         ///< as PiecesVerdict
    std::size_t tried = 0;       ///< times that the cutter was called
    std::size_t meshed = 0;      ///< times that pieces were meshed
};

}  // namespace pavior

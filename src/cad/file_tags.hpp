#pragma once
// Which entities of a file the pieces come from that its solids were cut into. Internal to the cad component.

#include "gmsh_topology.hpp"

#include <pavior/cad/imprint_report.hpp>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace pavior::detail {

/// What became of each solid of a file.
struct SolidPieces {
    std::map<int, std::vector<int>> pieces;  ///< by tag in the file, Gmsh's tags of its pieces
    std::map<int, double> volume;            ///< by tag in the file, before
};

/// The tags in the file of each entity of \p topology, by dimension and dense index; the first is the one to show.
/// Solids follow from \p pieces, what bounds them from their places: \p populate fills another model as the file does.
/// Entities that lie on none of the file get numbers beyond those.
std::array<std::vector<std::vector<int>>, 4> file_tags(const GmshModel& model, const Topology& topology,
                                                       const SolidPieces& pieces, const std::function<void()>& populate,
                                                       double tolerance);

/// Overlaps, gaps below \p near, pieces.
ImprintReport imprint_report(const GmshModel& model, const Topology& topology, const SolidPieces& pieces, double near);

}  // namespace pavior::detail

#pragma once
// Solids made with the CAD kernel behind Gmsh.
#include <pavior/brep/brep.hpp>

#include <gmsh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior::test {

namespace occ = gmsh::model::occ;

/// One solid minus others.
inline int cut(int from, const gmsh::vectorpair& tools) {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, from}}, tools, result, map);
    return result.at(0).second;
}

/// Makes touching solids share their faces.
inline void share_faces(const gmsh::vectorpair& solids) {
    gmsh::vectorpair shared;
    std::vector<gmsh::vectorpair> map;
    occ::fragment({solids.front()}, {solids.begin() + 1, solids.end()}, shared, map);
    occ::synchronize();
}

}  // namespace pavior::test

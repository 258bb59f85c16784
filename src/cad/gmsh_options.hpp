#pragma once
// Options of Gmsh for a while. Internal to the cad component.

#include <gmsh.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Sets options of Gmsh and puts the old values back.
class GmshOptions {
public:
    GmshOptions() = default;
    GmshOptions(const GmshOptions&) = delete;
    GmshOptions& operator=(const GmshOptions&) = delete;
    ~GmshOptions() {
        for (const auto& [name, value] : old_) {
            try {
                gmsh::option::setNumber(name, value);
            } catch (...) {  // it could be read, so it can be set
            }
        }
    }
    void set(const std::string& name, double value) {
        double old = 0;
        gmsh::option::getNumber(name, old);
        old_.emplace_back(name, old);
        gmsh::option::setNumber(name, value);
    }

private:
    std::vector<std::pair<std::string, double>> old_;
};

/// What every surface mesh of ours wants: linear, reproducible, sized by nothing but \p size (0: without limit) and the
/// number of elements \p per_turn of 2 pi (0: whatever the curvature), and never below \p least, which must be
/// positive: at the tip of a cone Gmsh would refine without end.
inline void set_mesh_options(GmshOptions& options, double size, double least, int per_turn = 0) {
    options.set("General.AbortOnError", 0);  // it throws inside a parallel region, which ends the process
    options.set("General.NumThreads", 1);
    options.set("Mesh.RandomSeed", 1);
    options.set("Mesh.ElementOrder", 1);
    options.set("Mesh.SubdivisionAlgorithm", 0);
    options.set("Mesh.RecombineAll", 0);
    options.set("Mesh.MeshOnlyVisible", 0);
    options.set("Mesh.MeshOnlyEmpty", 0);
    options.set("Mesh.MeshSizeFromPoints", 0);
    options.set("Mesh.MeshSizeFromCurvature", per_turn);
    options.set("Mesh.MeshSizeExtendFromBoundary", 1);
    options.set("Mesh.MeshSizeMin", least);
    options.set("Mesh.MeshSizeMax", size > 0.0 ? std::max(size, least) : 1e22);
}

}  // namespace pavior::detail

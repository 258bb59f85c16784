#pragma once
/// \file
/// The tries of try_method() that mesh between caps, and the last resort.

#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/submap/submap_classes.hpp>

#include <functional>
#include <span>

namespace pavior::detail {

/// What a try works with, and on.
struct Trial {
    const AnyModel& model;
    std::span<const SolidId> solids;
    const PartOptions& options;
    const Kernels& kernels;
    const std::function<bool()>& out_of_time;
    MethodTry& result;
    double seconds = 0;  ///< limit; 0: none
    /// How far a mesh of the method is from the model, where the method knows more of it than the faces of its quads.
    std::function<double(const HexMeshData&)> distance = {};
    SubmapOptions submap = {};  ///< with the lines of SolidCut::curves

    /// Wished length of mesh edges.
    [[nodiscard]] double size() const { return options.size > 0 ? options.size : model.diagonal() / 12; }
    void describe(const MethodReport& report) const {
        if (kernels.describe) {
            kernels.describe(result.report, model, report);
        }
    }
};

/// Each sets data, notes, warnings and report of the result. \throws what the methods throw
PAVIOR_INLINE void try_submap(Trial& trial);
PAVIOR_INLINE void try_sweep(Trial& trial);
PAVIOR_INLINE void try_multi_sweep(Trial& trial);
PAVIOR_INLINE void try_mixed(Trial& trial);
PAVIOR_INLINE void try_split(Trial& trial);

}  // namespace pavior::detail

#ifndef PAVIOR_COMPILED
#include <pavior/part/detail/trial-inl.hpp>
#endif

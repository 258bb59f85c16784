#pragma once
/// \file
/// How a mesh differs from the solids that it stands for.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/part/any_model.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// Lengths and volumes are those of the model.
struct CadDeviation {
    double volume = 0;                 ///< of the mesh
    std::optional<double> cad_volume;  ///< of the solids, where the model knows it
    /// Of all corners and centres of boundary quads, the largest distance from the faces they stand for; nothing where
    /// it was not measured.
    std::optional<double> distance;
    double between = 0;  ///< volume between the quads and curved faces, an upper estimate; meaningful with `distance`
    double size = 0;     ///< wished length of mesh edges; 0: none

    /// The volume of the mesh less that of the solids, in parts of the latter.
    [[nodiscard]] std::optional<double> relative_volume() const {
        return cad_volume && *cad_volume > 0 ? std::optional((volume - *cad_volume) / *cad_volume) : std::nullopt;
    }
    [[nodiscard]] std::optional<double> distance_in_sizes() const {
        return distance && size > 0 ? std::optional(*distance / size) : std::nullopt;
    }
};

/// Beyond these a mesh comes with a warning: parts of the volume, parts of the size.
inline constexpr double noteworthy_volume = 0.02;
inline constexpr double noteworthy_distance = 0.25;

/// Compares a mesh with the \p solids of \p b that it stands for.
/// \param quads,faces  its boundary, and the face of each quad; without faces the distance is unknown
/// \param volume       of the mesh
/// \param size         wished length of mesh edges
/// \param out_of_time  asked now and then; once true, nothing more is measured and the distance is unknown. Empty:
/// never.
/// O(quads), about five evaluations of the model each on curved faces (boundary_deviation()).
[[nodiscard]] PAVIOR_INLINE CadDeviation cad_deviation(const AnyModel& b, std::span<const SolidId> solids,
                                                       std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                                       std::span<const FaceId> faces, double volume, double size,
                                                       const std::function<bool()>& out_of_time = {});

/// Both together: volumes are added, the larger distance and size count; what one of them does not know is unknown.
[[nodiscard]] PAVIOR_INLINE CadDeviation operator+(const CadDeviation& a, const CadDeviation& b);

/// A sentence for each noteworthy difference, and one if the distance is not known.
[[nodiscard]] PAVIOR_INLINE std::vector<std::string> warnings_of(const CadDeviation& deviation);

/// Whether the volumes differ by more than a fine mesh can cost whose edges turn by \p max_angle degrees (two and a
/// half times what a disc loses, a ball loses twice that): it passes over a part of the solid. False where a volume is
/// not known.
[[nodiscard]] PAVIOR_INLINE bool lacks_a_part(const CadDeviation& deviation, double max_angle);

/// "volume -0.12 % off the CAD, boundary within 0.034 sizes of it", as far as known; else empty.
[[nodiscard]] PAVIOR_INLINE std::string text_of(const CadDeviation& deviation);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/cad_deviation-inl.hpp>
#endif

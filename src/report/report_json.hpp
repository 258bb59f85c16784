#pragma once
// Reports of the library as JSON: internal to pavior::part and the program.

#include <pavior/brep/brep.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/smooth/report.hpp>
#include <pavior/sweep/report.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace pavior {

struct SolidBlocks;
struct BlockReference;
struct SweptSolids;
struct SubmappedMesh;
struct BestMultiSweep;
struct MixedSolids;
struct SplitSolids;
struct DecomposedSolids;
struct SolidCut;
struct CadDeviation;
class AnyModel;

namespace detail {

[[nodiscard]] nlohmann::json to_json(const SmoothReport& report);
[[nodiscard]] nlohmann::json to_json(const SweepReport& report);
/// Counts, faults, quality, groups; with the names that they have in a file of \p format if one was written.
[[nodiscard]] nlohmann::json to_json(const HexMeshData& data, const MeshCheck& check,
                                     std::optional<MeshFormat> format = {});
/// Counts, sheets, violations and times of the steps.
[[nodiscard]] nlohmann::json to_json(const BlockReference& input, const SolidBlocks& solid);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const SweptSolids& swept);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const SubmappedMesh& mesh);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const BestMultiSweep& best);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const MixedSolids& mesh);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const SplitSolids& mesh);
[[nodiscard]] nlohmann::json to_json(const AnyModel& model, const DecomposedSolids& mesh);
/// The solid's position among the solids that the cuts before left, the reason, and the surfaces.
[[nodiscard]] nlohmann::json to_json(const SolidCut& cut);

/// Volumes, distance, and both in parts of what they are measured by; null where unknown.
[[nodiscard]] nlohmann::json to_json(const CadDeviation& deviation);

/// Number of cells of each group {dimension, number}.
[[nodiscard]] std::map<std::pair<int, int>, std::size_t> group_sizes(const HexMeshData& data);

struct NamedMetric {
    const char* title;
    const char* key;
    const Statistics* statistics;
};
/// The measures of quality with their names in reports and in tables.
[[nodiscard]] std::array<NamedMetric, 3> metrics(const HexQuality& quality);

}  // namespace detail

}  // namespace pavior

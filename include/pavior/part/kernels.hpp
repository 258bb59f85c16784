#pragma once
/// \file
/// What mesh_part() needs besides the model: the machines of others, in one bundle.

#include <pavior/brep/solids_tets.hpp>
#include <pavior/decompose/solid_cut.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/many_to_many/plane_arrangement.hpp>
#include <pavior/many_to_many/plane_region.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/mesh/tagged_mesh.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/cad_deviation.hpp>

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace pavior {

struct SubmappedMesh;
struct SweptSolids;
struct BestMultiSweep;
struct MixedSolids;
struct BlockedModel;
struct SplitSolids;
struct DecomposedSolids;
struct SmoothReport;

/// Tetrahedra to block, and the surface that they fill.
struct BlockReference {
    ReferenceMesh mesh;
    TaggedSurface surface;         ///< tags of its triangles are those of the faces of the model, where it has tags
    bool cad = false;              ///< the surface is that of a CAD model
    double chord = 0;              ///< largest distance of the surface from that of the CAD model
    std::optional<double> volume;  ///< of the CAD model, where it is one
    std::vector<std::string> warnings;  ///< of a CAD model: overlaps and gaps of its solids
    double read_seconds = 0, tetra_seconds = 0;
};

/// Makes the tetrahedra of one solid: make(solid, size, features) is a BlockReference. Triangles lie as close to curved
/// faces as hexahedra of \p size need it; feature angles are \p features.
template <class M>
concept reference_mesher = requires(M& make, SolidId solid, double size, const FeatureOptions& features) {
    { make(solid, size, features) } -> std::convertible_to<BlockReference>;
};

/// A mesh of some solids as it was judged.
struct JudgedMesh {
    const HexMeshData* data;
    MeshCheck check;
    CadDeviation deviation;
};

/// What a method says of its own work, and what follows on it; none is null.
using MethodReport = std::variant<const SubmappedMesh*, const SweptSolids*, const BestMultiSweep*, const MixedSolids*,
                                  const BlockedModel*, const SplitSolids*, const DecomposedSolids*, const SmoothReport*,
                                  const JudgedMesh*>;

/// Any reference_mesher that can be copied, behind one type; std::ref() of one that cannot.
using ReferenceMesher = std::function<BlockReference(SolidId solid, double size, const FeatureOptions& features)>;

/// Makes the tetrahedra of solids that may touch: make(solids, sizes) is a SolidsTets.
template <class M>
concept tet_mesher = requires(M& make, std::span<const SolidId> solids, const TetSizes& sizes) {
    { make(solids, sizes) } -> std::convertible_to<SolidsTets>;
};

/// Any tet_mesher that can be copied, behind one type; std::ref() of one that cannot.
using TetMesher = std::function<SolidsTets(std::span<const SolidId> solids, const TetSizes& sizes)>;

/// What cuts left of the solids of a model; solid_pieces.
struct ModelPieces {
    std::shared_ptr<const AnyModel> model;
    std::vector<SolidId> solid;
    CapMesher caps;  ///< quads of faces of the pieces
    /// Finds, by face of the pieces, the face that it is a piece of, not valid for one that was cut, and gives solids,
    /// faces and edges of the pieces the tags of what they are pieces of. Called before they are meshed.
    std::function<std::vector<FaceId>()> identify;
    std::vector<EdgeId> turns = {};  ///< edges on the curves of the cuts, as edges_on_curves()
};

/// Any solid_cutter that can be copied, behind one type; std::ref() of one that cannot.
using SolidCutter = std::function<std::optional<ModelPieces>(std::span<const SolidCut> cuts)>;

/// The callables that mesh a model: pavior::part has them for CAD files. All are called one at a time. A method that
/// needs one that is empty ends as TryOutcome::died.
struct Kernels {
    PlaneImprinter imprint;     ///< curves in a plane, cut by each other
    IntegerSolver solver;       ///< of integer programs
    RegionMesher regions;       ///< quads of plane regions
    CapMesher caps;             ///< quads of faces
    ReferenceMesher reference;  ///< tetrahedra of a solid
    /// May add what it makes of a method's own reports to MethodTry::report; may be empty.
    std::function<void(std::string& text, const AnyModel& model, const MethodReport& report)> describe = {};
    TetMesher tets = {};   ///< sized tetrahedra of solids; empty: there is no last resort
    SolidCutter cut = {};  ///< of the model; empty: nothing is cut
    /// Other tetrahedra of a solid with curved faces, taken one after the other where blocks in those before are none
    /// or poor: where sheets run depends on the tetrahedra. May be empty.
    std::vector<ReferenceMesher> other_references = {};
};

}  // namespace pavior

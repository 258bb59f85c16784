#pragma once
/// \file
/// Cuts solids of a CAD model into pieces that share faces.

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/decompose/solid_cut.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// What cuts left of the solids of a model.
struct GmshPieces {
    std::shared_ptr<GmshBrep> model;
    std::vector<SolidId> solid;  ///< by solid of model: the solid that it is a piece of
};

/// Cuts the solids of one model by OpenCASCADE's general fuse; a solid_cutter. The model is copied through a file in a
/// temporary folder, which lives as long as the cutter and its copies. The model must outlive the cutter. NOT
/// thread-safe (see GmshBrep).
class GmshCutter {
public:
    explicit GmshCutter(const GmshBrep& model);

    /// All cuts, again in each call: some 10 ms each, more for large models. Nothing where the surfaces do not divide
    /// the solid of their cut, a piece has less than 2e-4 of the volume of its solid or is thinner than 1e-3 of the
    /// diagonal of the model, volumes do not add up to 1e-4, the kernel fails, or there is no place for the copy.
    /// \throws InputError bad_index of a solid
    [[nodiscard]] std::optional<GmshPieces> operator()(std::span<const SolidCut> cuts) const;

    /// By face of \p pieces, which must come from this cutter: the face of the model that it is a piece of, not valid
    /// for one that was cut. Gives the entities of the pieces the tags of what they lie on; edges and vertices have
    /// one each, and what is new has numbers beyond those of the model. Found by points: up to some milliseconds a
    /// face.
    [[nodiscard]] std::vector<FaceId> identify(GmshPieces& pieces) const;

    /// Writes the pieces to a .brep file. \throws FileError; InputError bad_option where the cuts give no pieces
    void save(std::span<const SolidCut> cuts, const std::filesystem::path& file) const;

private:
    struct Base;
    std::shared_ptr<const Base> base_;
};

static_assert(solid_cutter<GmshCutter, GmshPieces>);

}  // namespace pavior

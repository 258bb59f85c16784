#pragma once
// A cutter without a CAD kernel: solids made of boxes, divided by the planes of their lattice.
#include "support/voxel_brep.hpp"

#include <pavior/decompose/solid_cut.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace pavior::test {

/// Pieces that can be moved, not copied, and have no default.
struct VoxelPieces {
    struct Kept {
        Voxels voxels;
        VoxelBrep brep;
    };
    class Model {
    public:
        explicit Model(std::unique_ptr<const Kept> kept) : kept_(std::move(kept)) {}
        [[nodiscard]] const TestBrep& operator*() const { return kept_->brep.brep(); }
        [[nodiscard]] const Voxels& voxels() const { return kept_->voxels; }

    private:
        std::unique_ptr<const Kept> kept_;
    };

    VoxelPieces(Model m, std::vector<SolidId> s) : model(std::move(m)), solid(std::move(s)) {}

    Model model;
    std::vector<SolidId> solid;
};

/// Planes of the lattice divide the cells of a solid; pieces are what hangs together by faces on one side of all
/// planes. Nothing where a surface is none of these planes, or does not divide.
class VoxelCutter {
public:
    explicit VoxelCutter(Voxels voxels) : voxels_(std::move(voxels)) {}

    std::optional<VoxelPieces> operator()(std::span<const SolidCut> cuts) {
        ++calls;
        Voxels now = voxels_;
        std::vector<int> origin;
        for (int s = 0; s < *std::max_element(now.label.begin(), now.label.end()); ++s) {
            origin.push_back(s);
        }
        for (const SolidCut& cut : cuts) {
            if (!divide(now, cut, origin)) {
                return std::nullopt;
            }
        }
        VoxelBrep brep(now, flipped);
        if (!brep.sound()) {
            return std::nullopt;
        }
        std::vector<SolidId> solid;
        for (const int s : origin) {
            solid.push_back(SolidId{s});
        }
        auto kept = std::make_unique<const VoxelPieces::Kept>(VoxelPieces::Kept{std::move(now), std::move(brep)});
        return VoxelPieces(VoxelPieces::Model(std::move(kept)), std::move(solid));
    }

    bool flipped = false;  ///< as VoxelBrep
    std::size_t calls = 0;

private:
    /// The plane of the lattice: axis and number.
    [[nodiscard]] static std::optional<std::pair<std::size_t, int>> plane_of(const Voxels& v,
                                                                             const CutSurface& surface) {
        const auto* plane = std::get_if<CutPlane>(&surface);
        for (std::size_t a = 0; plane && a < 3; ++a) {
            const auto axis = static_cast<Eigen::Index>(a);
            for (int p = 0; std::abs(plane->normal[axis]) > 1 - 1e-9 && p <= v.size[a]; ++p) {
                if (std::abs(v.at[a][static_cast<std::size_t>(p)] - plane->point[axis]) < 1e-9) {
                    return std::pair(a, p);
                }
            }
        }
        return std::nullopt;
    }

    static bool divide(Voxels& v, const SolidCut& cut, std::vector<int>& origin) {
        std::vector<std::pair<std::size_t, int>> planes;
        for (const CutSurface& surface : cut.surfaces) {
            const auto plane = plane_of(v, surface);
            if (!plane) {
                return false;
            }
            planes.push_back(*plane);
        }
        std::vector<int> piece(v.label.size(), -1);
        int count = 0;
        for_each_cell(v, [&](const std::array<int, 3>& start) {
            if (v(start) != cut.solid.value + 1 || piece[v.index(start)] >= 0) {
                return;
            }
            std::vector<std::array<int, 3>> open{start};
            piece[v.index(start)] = count;
            while (!open.empty()) {
                const std::array<int, 3> c = open.back();
                open.pop_back();
                for (std::size_t a = 0; a < 3; ++a) {
                    for (const int step : {-1, 1}) {
                        std::array<int, 3> next = c;
                        next[a] += step;
                        const bool cut_off = std::find(planes.begin(), planes.end(),
                                                       std::pair(a, std::max(c[a], next[a]))) != planes.end();
                        if (!cut_off && v(next) == cut.solid.value + 1 && piece[v.index(next)] < 0) {
                            piece[v.index(next)] = count;
                            open.push_back(next);
                        }
                    }
                }
            }
            ++count;
        });
        if (count < 2) {
            return false;
        }
        // The pieces take the place of the solid.
        for_each_cell(v, [&](const std::array<int, 3>& c) {
            int& label = v.label[v.index(c)];
            if (label == cut.solid.value + 1) {
                label += piece[v.index(c)];
            } else if (label > cut.solid.value + 1) {
                label += count - 1;
            }
        });
        origin.insert(origin.begin() + cut.solid.value, static_cast<std::size_t>(count - 1), origin[cut.solid.index()]);
        return true;
    }

    template <class F>
    static void for_each_cell(const Voxels& v, F&& f) {
        for (int k = 0; k < v.size[2]; ++k) {
            for (int j = 0; j < v.size[1]; ++j) {
                for (int i = 0; i < v.size[0]; ++i) {
                    f(std::array{i, j, k});
                }
            }
        }
    }

    Voxels voxels_;
};

static_assert(solid_cutter<VoxelCutter, VoxelPieces>);

/// A box with arms in three directions, on the lattice; what submapping takes, if it is cut or not.
inline Voxels star() {
    Voxels voxels(3, 3, 3);
    voxels.fill({0, 1, 1}, {3, 2, 2}, 1);
    voxels.fill({1, 0, 1}, {2, 3, 2}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 3}, 1);
    return voxels;
}

}  // namespace pavior::test

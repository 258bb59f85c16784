#pragma once
// Which entities of a model a point lies on. Internal to the cad component.

#include "gmsh_model.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace pavior::detail {

/// The box of an entity of the current model.
struct EntityBox {
    Vec3 low, high;

    EntityBox(int dim, int tag) {
        gmsh::model::getBoundingBox(dim, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    }
    [[nodiscard]] bool holds(const Vec3& x, double slack) const {
        return ((x.array() >= low.array() - slack) && (x.array() <= high.array() + slack)).all();
    }
    [[nodiscard]] bool near(const EntityBox& other, double slack) const {
        return ((other.high.array() >= low.array() - slack) && (other.low.array() <= high.array() + slack)).all();
    }
};

/// Finds the vertices, edges and faces of a model by a point that lies on them. A view of the model.
class EntitiesAt {
public:
    EntitiesAt(const GmshModel& model, double tolerance);

    /// Ascending tags of those on which \p x lies.
    [[nodiscard]] std::vector<int> at(int dim, const Vec3& x) const;
    /// The largest tag.
    [[nodiscard]] int last(int dim) const;

private:
    [[nodiscard]] bool on(int dim, int tag, const Vec3& x) const;
    [[nodiscard]] bool on_edge(int tag, const Vec3& x) const;

    const GmshModel& model_;
    double tolerance_;
    std::array<std::map<int, EntityBox>, 3> boxes_;
};

}  // namespace pavior::detail

#pragma once
/// \file
/// Nodes of a mesh that slide on the faces and edges of its model.

#include <pavior/brep/nearest_edge.hpp>
#include <pavior/brep/node_entities.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/model_extras.hpp>
#include <pavior/smooth/node_guide.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace pavior {

/// The entity of a node that stays where it is, for whatever reason.
[[nodiscard]] inline NodeEntity held_node() { return {0, -1, Vec2::Zero()}; }

/// The node_guide of a mesh whose nodes know what they lie on: those of dimension 0 (vertices) are fixed, those of 1
/// and 2 slide on their edge or face, those of 3 are free. Points are sought from the parameters of the node on, and on
/// straight edges and plane faces without the model; between two calls nothing is remembered that matters. Concurrent
/// if all edges and faces in use are straight and plane. A view of the model, not to be copied.
class EntityGuide {
public:
    /// \param entities   one a node
    /// \param precision  to which a point lies on its face, a length
    /// O(nodes + edges of the model), some evaluations an edge or face.
    PAVIOR_INLINE EntityGuide(const AnyModel& b, std::vector<NodeEntity> entities, double precision);
    EntityGuide(const EntityGuide&) = delete;
    EntityGuide& operator=(const EntityGuide&) = delete;

    [[nodiscard]] std::size_t size() const { return entities_.size(); }
    [[nodiscard]] Freedom freedom(Index i) const { return static_cast<Freedom>(entities_[i].dimension); }
    /// The point of the edge (within its ends) or face (its whole surface) next to \p x.
    [[nodiscard]] PAVIOR_INLINE Vec3 project(Index i, const Vec3& x) const;
    /// Tangent or normal there; null where the surface has none.
    [[nodiscard]] PAVIOR_INLINE Vec3 direction(Index i, const Vec3& x) const;
    [[nodiscard]] bool concurrent() const { return !curved_; }

private:
    struct Line {
        Vec3 from, along;  ///< along / its square length: the parameter from 0 to 1
    };
    [[nodiscard]] PAVIOR_INLINE Vec2 parameters(Index i, const Vec3& x) const;

    const AnyModel& b_;
    std::vector<NodeEntity> entities_;
    double precision_;
    std::map<std::int32_t, std::optional<Line>> lines_;
    std::map<std::int32_t, std::optional<FacePlane>> planes_;
    mutable NearestEdge<AnyModel> near_edge_;
    bool curved_ = false;
};

static_assert(node_guide<EntityGuide>);
static_assert(static_cast<int>(Freedom::fixed) == 0 && static_cast<int>(Freedom::curve) == 1 &&
              static_cast<int>(Freedom::surface) == 2 && static_cast<int>(Freedom::space) == 3);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/entity_guide-inl.hpp>
#endif

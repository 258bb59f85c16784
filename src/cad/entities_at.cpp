#include "entities_at.hpp"

namespace pavior::detail {

EntitiesAt::EntitiesAt(const GmshModel& model, double tolerance) : model_(model), tolerance_(tolerance) {
    const GmshModel::Current there(model_);
    for (const int dim : {0, 1, 2}) {
        gmsh::vectorpair list;
        gmsh::model::getEntities(list, dim);
        for (const auto& [d, tag] : list) {
            boxes_[static_cast<std::size_t>(dim)].emplace(tag, EntityBox(dim, tag));
        }
    }
}

std::vector<int> EntitiesAt::at(int dim, const Vec3& x) const {
    const GmshModel::Current there(model_);
    std::vector<int> tags;
    for (const auto& [tag, box] : boxes_[static_cast<std::size_t>(dim)]) {
        if (box.holds(x, tolerance_) && on(dim, tag, x)) {
            tags.push_back(tag);
        }
    }
    return tags;
}

int EntitiesAt::last(int dim) const {
    const auto& boxes = boxes_[static_cast<std::size_t>(dim)];
    return boxes.empty() ? 0 : boxes.rbegin()->first;
}

bool EntitiesAt::on(int dim, int tag, const Vec3& x) const {
    if (dim == 0) {
        return (model_.vertex_point(tag) - x).norm() <= tolerance_;
    }
    if (dim == 1) {
        return on_edge(tag, x);
    }
    Vec2 uv;
    if (!model_.project_on_face(tag, x, uv)) {
        return false;
    }
    std::array<Vec3, 1> there;
    model_.face_points(tag, std::array{uv}, there);
    return (there[0] - x).norm() <= tolerance_ && model_.inside_face(tag, uv);
}

/// By the parameter of the point: Gmsh's getClosestPoint() leaves that of an edge unset.
bool EntitiesAt::on_edge(int tag, const Vec3& x) const {
    std::vector<double> t;
    try {
        gmsh::model::getParametrization(1, tag, {x[0], x[1], x[2]}, t);
    } catch (...) {
        return false;
    }
    const auto range = model_.edge_range(tag);
    const double slack = 1e-6 * (range[1] - range[0]);
    if (t.size() != 1 || !(t[0] >= range[0] - slack && t[0] <= range[1] + slack)) {
        return false;
    }
    std::array<Vec3, 1> there;
    model_.edge_points(tag, t, there);
    return (there[0] - x).norm() <= tolerance_;
}

}  // namespace pavior::detail

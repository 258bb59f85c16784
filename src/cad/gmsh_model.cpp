#include "gmsh_model.hpp"

#include <cstdio>
#include <iostream>

#include <fcntl.h>
#include <unistd.h>

namespace pavior::detail {

namespace {

void copy_points(const std::vector<double>& flat, std::span<Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = Vec3(flat.at(3 * i), flat.at(3 * i + 1), flat.at(3 * i + 2));
    }
}

void flatten(std::span<const Vec2> uv, std::vector<double>& flat) {
    flat.resize(2 * uv.size());
    for (std::size_t i = 0; i < uv.size(); ++i) {
        flat[2 * i] = uv[i].x();
        flat[2 * i + 1] = uv[i].y();
    }
}

}  // namespace

std::string entity_label(int dim, int tag) {
    static constexpr std::array<const char*, 4> names{"vertex ", "edge ", "face ", "solid "};
    return names.at(static_cast<std::size_t>(dim)) + std::to_string(tag);
}

GmshModel::GmshModel() {
    static unsigned count = 0;
    name_ = "pavior-" + std::to_string(++count);
    std::string previous;
    gmsh::model::getCurrent(previous);
    gmsh::model::add(name_);
    gmsh::model::setCurrent(previous);
}

GmshModel::~GmshModel() {
    try {
        std::string previous;
        gmsh::model::getCurrent(previous);
        gmsh::model::setCurrent(name_);
        gmsh::model::remove();
        if (previous != name_) {
            gmsh::model::setCurrent(previous);
        }
    } catch (...) {  // the model is gone already
    }
}

GmshModel::Current::Current(const GmshModel& model) {
    gmsh::model::getCurrent(previous_);
    switched_ = previous_ != model.name_;
    if (switched_) {
        gmsh::model::setCurrent(model.name_);
    }
}

GmshModel::Current::~Current() {
    if (switched_) {
        try {
            gmsh::model::setCurrent(previous_);
        } catch (...) {  // the other model is gone
        }
    }
}

std::array<double, 2> GmshModel::edge_range(int tag) const {
    const Current current(*this);
    return on_entity(1, tag, [&] {
        gmsh::model::getParametrizationBounds(1, tag, in_, out_);
        return std::array{in_.at(0), out_.at(0)};
    });
}

std::array<Vec2, 2> GmshModel::face_bounds(int tag) const {
    const Current current(*this);
    return on_entity(2, tag, [&] {
        gmsh::model::getParametrizationBounds(2, tag, in_, out_);
        return std::array{Vec2(in_.at(0), in_.at(1)), Vec2(out_.at(0), out_.at(1))};
    });
}

Vec3 GmshModel::vertex_point(int tag) const {
    const Current current(*this);
    return on_entity(0, tag, [&] {
        gmsh::model::getValue(0, tag, {}, out_);
        return Vec3(out_.at(0), out_.at(1), out_.at(2));
    });
}

void GmshModel::edge_points(int tag, std::span<const double> t, std::span<Vec3> points) const {
    const Current current(*this);
    on_entity(1, tag, [&] {
        in_.assign(t.begin(), t.end());
        gmsh::model::getValue(1, tag, in_, out_);
        copy_points(out_, points);
    });
}

Vec3 GmshModel::edge_derivative(int tag, double t) const {
    const Current current(*this);
    return on_entity(1, tag, [&] {
        in_.assign(1, t);
        gmsh::model::getDerivative(1, tag, in_, out_);
        return Vec3(out_.at(0), out_.at(1), out_.at(2));
    });
}

void GmshModel::face_points(int tag, std::span<const Vec2> uv, std::span<Vec3> points) const {
    const Current current(*this);
    on_entity(2, tag, [&] {
        flatten(uv, in_);
        gmsh::model::getValue(2, tag, in_, out_);
        copy_points(out_, points);
    });
}

void GmshModel::face_derivatives(int tag, std::span<const Vec2> uv, std::span<std::array<Vec3, 2>> derivatives) const {
    const Current current(*this);
    on_entity(2, tag, [&] {
        flatten(uv, in_);
        gmsh::model::getDerivative(2, tag, in_, out_);
        for (std::size_t i = 0; i < derivatives.size(); ++i) {
            derivatives[i] = {Vec3(out_.at(6 * i), out_.at(6 * i + 1), out_.at(6 * i + 2)),
                              Vec3(out_.at(6 * i + 3), out_.at(6 * i + 4), out_.at(6 * i + 5))};
        }
    });
}

void GmshModel::edge_on_face(int edge, std::span<const double> t, int face, int side, std::span<Vec2> uv) const {
    const Current current(*this);
    on_entity(1, edge, [&] {
        in_.assign(t.begin(), t.end());
        gmsh::model::reparametrizeOnSurface(1, edge, in_, face, out_, side);
        for (std::size_t i = 0; i < uv.size(); ++i) {
            uv[i] = Vec2(out_.at(2 * i), out_.at(2 * i + 1));
        }
    });
}

bool GmshModel::project_on_face(int tag, const Vec3& x, Vec2& uv) const {
    const Current current(*this);
    try {
        in_.assign(x.data(), x.data() + 3);
        gmsh::model::getParametrization(2, tag, in_, out_);
        if (out_.size() != 2) {
            return false;
        }
        uv = Vec2(out_[0], out_[1]);
        return uv.allFinite();
    } catch (...) {
        return false;
    }
}

bool GmshModel::inside_face(int tag, const Vec2& uv) const {
    const Current current(*this);
    return on_entity(2, tag, [&] {
        in_.assign(uv.data(), uv.data() + 2);
        return gmsh::model::isInside(2, tag, in_) > 0;
    });
}

double GmshModel::mass(int dim, int tag) const {
    const Current current(*this);
    return on_entity(dim, tag, [&] {
        double value = 0;
        gmsh::model::occ::getMass(dim, tag, value);
        return value;
    });
}

Hush::Hush() {
    std::cout.flush();
    std::fflush(stdout);
    out_ = std::cout.rdbuf(nullptr);
    error_ = std::cerr.rdbuf(nullptr);
    descriptor_ = dup(STDOUT_FILENO);
    if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        close(nowhere);
    }
}

Hush::~Hush() {
    std::fflush(stdout);
    if (descriptor_ >= 0) {
        dup2(descriptor_, STDOUT_FILENO);
        close(descriptor_);
    }
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
}

}  // namespace pavior::detail

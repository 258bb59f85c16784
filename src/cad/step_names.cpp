#include "step_names.hpp"

#include "step_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <vector>

namespace pavior::detail {

namespace {

constexpr double tolerance = 1e-4;

/// What of a solid or a face can be compared, in both models: lengths in units of the kernel.
struct Shape {
    std::size_t vertices = 0;
    Vec3 centre = Vec3::Zero();  ///< of the vertices
    double radius = 0;           ///< the farthest vertex from there
    double mean = 0;             ///< the mean distance of the vertices from there
};

Shape shape_of(const std::vector<Vec3>& points, double scale) {
    Shape shape;
    shape.vertices = points.size();
    for (const Vec3& x : points) {
        shape.centre += scale * x / static_cast<double>(points.size());
    }
    for (const Vec3& x : points) {
        const double distance = (scale * x - shape.centre).norm();
        shape.radius = std::max(shape.radius, distance);
        shape.mean += distance / static_cast<double>(points.size());
    }
    return shape;
}

bool near(double a, double b, double size) { return std::abs(a - b) <= tolerance * size; }

bool alike(const Shape& a, const Shape& b, double size) {
    return a.vertices == b.vertices && near(a.radius, b.radius, size) && near(a.mean, b.mean, size);
}

std::vector<Vec3> points_of(int dim, int tag) {
    gmsh::vectorpair vertices;
    gmsh::model::getBoundary({{dim, tag}}, vertices, false, false, true);
    std::set<int> tags;
    std::vector<Vec3> points;
    for (const auto& [d, vertex] : vertices) {
        if (d == 0 && tags.insert(vertex).second) {
            std::vector<double> x;
            gmsh::model::getValue(0, vertex, {}, x);
            points.emplace_back(x[0], x[1], x[2]);
        }
    }
    return points;
}

/// A solid of the model.
struct KernelSolid {
    int tag = 0;
    std::string label;
    std::vector<int> faces;
    Shape shape;
};

std::vector<KernelSolid> kernel_solids() {
    gmsh::vectorpair solids;
    gmsh::model::getEntities(solids, 3);
    std::vector<KernelSolid> result;
    for (const auto& [dim, tag] : solids) {
        KernelSolid& solid = result.emplace_back();
        solid.tag = tag;
        gmsh::model::getEntityName(dim, tag, solid.label);
        gmsh::vectorpair faces;
        gmsh::model::getBoundary({{dim, tag}}, faces, false, false, false);
        for (const auto& face : faces) {
            solid.faces.push_back(face.second);
        }
        solid.shape = shape_of(points_of(dim, tag), 1.0);
    }
    return result;
}

/// True if \p label is a path whose last part is \p name, as it stands in the file or as it is meant.
bool ends_with(const std::string& label, const std::string& name) {
    const auto ends = [&](const std::string& end) {
        return !end.empty() && label.size() > end.size() &&
               label.compare(label.size() - end.size(), end.size(), end) == 0 &&
               label[label.size() - end.size() - 1] == '/';
    };
    return ends(name) || ends(step_string(name));
}

/// Finds which solid of the file each solid of the model is.
class Matching {
public:
    Matching(const std::vector<KernelSolid>& solids, const std::vector<StepSolid>& steps)
        : solids_(solids), steps_(steps), used_(steps.size(), 0) {
        double kernel = 0;
        double file = 0;
        for (const KernelSolid& solid : solids) {
            kernel = std::max(kernel, solid.shape.radius);
        }
        for (const StepSolid& step : steps) {
            file = std::max(file, shape_of(step.vertices, 1.0).radius);
        }
        // The same solids in both, but in other units: so much longer is the kernel's.
        scale_ = file > 0 && kernel > 0 ? kernel / file : 1.0;
        for (const StepSolid& step : steps) {
            shapes_.push_back(shape_of(step.vertices, scale_));
        }
    }

    [[nodiscard]] double scale() const { return scale_; }

    /// For each solid of the model its position among those of the file.
    std::vector<std::optional<std::size_t>> run() {
        std::vector<std::optional<std::size_t>> found(solids_.size());
        for (const int level : {0, 1, 2, 3}) {
            for (std::size_t i = 0; i < solids_.size(); ++i) {
                for (std::size_t k = 0; k < steps_.size() && !found[i]; ++k) {
                    if (used_[k] == 0 && fits(i, k, level)) {
                        used_[k] = 1;
                        found[i] = k;
                    }
                }
            }
        }
        return found;
    }

private:
    /// From sure to likely: label, shape and place; label and shape; shape; label and number of faces.
    [[nodiscard]] bool fits(std::size_t i, std::size_t k, int level) const {
        const KernelSolid& solid = solids_[i];
        const StepSolid& step = steps_[k];
        if (solid.faces.size() != step.faces.size()) {
            return level == 3 && !solid.label.empty() && ends_with(solid.label, step.product);
        }
        const bool label = solid.label.empty() || step.product.empty() || ends_with(solid.label, step.product);
        const double size = std::max(solid.shape.radius, std::numeric_limits<double>::min());
        const bool shape = alike(solid.shape, shapes_[k], size);
        const bool place = step.placed || (solid.shape.centre - shapes_[k].centre).norm() <= tolerance * size;
        switch (level) {
            case 0: return label && shape && place;
            case 1: return label && shape;
            case 2: return shape;
            default: return label;
        }
    }

    const std::vector<KernelSolid>& solids_;
    const std::vector<StepSolid>& steps_;
    std::vector<char> used_;
    std::vector<Shape> shapes_;
    double scale_ = 1;
};

/// A face seen from its solid.
struct FaceShape {
    Shape own;
    double distance = 0;  ///< between the centres
};

FaceShape face_shape(const std::vector<Vec3>& points, double scale, const Shape& solid) {
    FaceShape face{shape_of(points, scale), 0};
    face.distance = (face.own.centre - solid.centre).norm();
    return face;
}

/// Finds which face of a solid of the file each face of the model's solid is.
class FaceMatching {
public:
    FaceMatching(const KernelSolid& solid, const StepSolid& step, double scale)
        : size_(std::max(solid.shape.radius, std::numeric_limits<double>::min())),
          used_(step.faces.size(), 0),
          found_(solid.faces.size()) {
        const Shape whole = shape_of(step.vertices, scale);
        for (const int tag : solid.faces) {
            kernel_.push_back(face_shape(points_of(2, tag), 1.0, solid.shape));
        }
        for (const StepFace& face : step.faces) {
            file_.push_back(face_shape(face.vertices, scale, whole));
        }
        in_place_ = !step.placed || ((solid.shape.centre - whole.centre).norm() <= tolerance * size_ && all_in_place());
        in_order_ = !step.surface && kernel_.size() == file_.size();
    }

    /// Positions among the faces of the file.
    std::vector<std::optional<std::size_t>> run() {
        for (std::size_t i = 0; i < kernel_.size() && in_order_; ++i) {  // the kernel keeps the order of the shell
            if (fits(i, i)) {
                take(i, i);
            }
        }
        for (std::size_t i = 0; i < kernel_.size(); ++i) {
            if (const auto only = only_fit(i); !found_[i] && only) {
                take(i, *only);
            }
        }
        for (std::size_t i = 0; i < kernel_.size() && in_order_; ++i) {  // without vertices, or mended
            if (!found_[i] && used_[i] == 0) {
                take(i, i);
            }
        }
        return found_;
    }

private:
    void take(std::size_t i, std::size_t k) {
        used_[k] = 1;
        found_[i] = k;
    }

    [[nodiscard]] bool same_place(const FaceShape& a, const FaceShape& b) const {
        return (a.own.centre - b.own.centre).norm() <= tolerance * size_;
    }
    [[nodiscard]] bool all_in_place() const {
        return std::all_of(file_.begin(), file_.end(), [&](const FaceShape& a) {
            return std::any_of(kernel_.begin(), kernel_.end(), [&](const FaceShape& b) { return same_place(a, b); });
        });
    }
    [[nodiscard]] bool fits(std::size_t i, std::size_t k) const {
        return (!in_place_ || same_place(kernel_[i], file_[k])) && alike(kernel_[i].own, file_[k].own, size_) &&
               near(kernel_[i].distance, file_[k].distance, size_);
    }
    [[nodiscard]] std::optional<std::size_t> only_fit(std::size_t i) const {
        std::optional<std::size_t> only;
        for (std::size_t k = 0; k < file_.size(); ++k) {
            if (used_[k] == 0 && fits(i, k)) {
                if (only) {
                    return std::nullopt;
                }
                only = k;
            }
        }
        return only;
    }

    double size_;
    std::vector<FaceShape> kernel_;
    std::vector<FaceShape> file_;
    std::vector<char> used_;
    std::vector<std::optional<std::size_t>> found_;
    bool in_place_ = true;  ///< no assembly has moved the solid
    bool in_order_ = true;
};

void name_faces(const KernelSolid& solid, const StepSolid& step, double scale, EntityNames& names) {
    if (std::all_of(step.faces.begin(), step.faces.end(), [](const StepFace& face) { return face.name.empty(); })) {
        return;
    }
    const auto found = FaceMatching(solid, step, scale).run();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] && !step.faces[*found[i]].name.empty()) {
            names[{2, solid.faces[i]}] = step.faces[*found[i]].name;
        }
    }
}

/// The longest name of a product that the label ends with.
std::string product_at_end(const std::string& label, const std::vector<StepSolid>& steps) {
    std::string longest;
    for (const StepSolid& step : steps) {
        const std::string name = step_string(step.product);
        if (ends_with(label, step.product) && name.size() > longest.size()) {
            longest = name;
        }
    }
    return longest;
}

}  // namespace

void name_step_entities(const std::string& text, EntityNames& names) {
    const std::vector<StepSolid> steps = read_step_solids(text);
    const std::vector<KernelSolid> solids = kernel_solids();
    Matching matching(solids, steps);
    const auto found = matching.run();
    for (std::size_t i = 0; i < solids.size(); ++i) {
        std::string name;
        if (found[i]) {
            name = steps[*found[i]].name;
            name_faces(solids[i], steps[*found[i]], matching.scale(), names);
        } else {
            name = product_at_end(solids[i].label, steps);
        }
        if (!name.empty()) {
            names[{3, solids[i].tag}] = name;
        } else if (found[i]) {
            names.erase({3, solids[i].tag});
        }
    }
}

}  // namespace pavior::detail

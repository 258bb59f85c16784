// The seven examples of section 5.7 (Roca 2009): blocks from local dual contributions.
//
// Each solid is made here, filled with tetrahedra, cut by sheets and decomposed. The rows are those of tables 5.2 to
// 5.8: nodes and elements of the reference mesh, of the dual surfaces (the contributions as polygons), of the dual
// regions (15 polyhedra a tetrahedron) and of the block mesh, ours and the thesis'. Only the last row belongs to the
// solid; the others belong to the tetrahedra at hand. With a directory as argument the surfaces of the solids are
// written there.
#include <pavior/block/block_solid.hpp>
#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_surfaces.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

using pavior::Index;
using pavior::TaggedSurface;
using pavior::Vec3;

namespace {

const double pi = std::acos(-1.0);

using Polygon = std::vector<Vec3>;

// A closed surface put together from polygons and prisms: polygons that are there twice cancel out.
class Surface {
public:
    // Counter-clockwise seen from outside.
    void add(const Polygon& polygon) {
        std::vector<Index> ids;
        for (const Vec3& x : polygon) {
            ids.push_back(weld(x));
        }
        std::vector<Index> key = ids;
        std::sort(key.begin(), key.end());
        if (faces_.erase(key) == 0) {
            faces_[key] = ids;
        }
    }

    // The prism between two polygons with as many points; which of them is the bottom does not matter.
    void add_prism(Polygon bottom, Polygon top) {
        Vec3 normal = Vec3::Zero();
        for (std::size_t i = 0; i < bottom.size(); ++i) {
            normal += bottom[i].cross(bottom[(i + 1) % bottom.size()]);
        }
        if (normal.dot(top[0] - bottom[0]) < 0) {
            std::reverse(bottom.begin(), bottom.end());
            std::reverse(top.begin(), top.end());
        }
        for (std::size_t i = 0; i < bottom.size(); ++i) {
            const std::size_t j = (i + 1) % bottom.size();
            add({bottom[i], bottom[j], top[j], top[i]});
        }
        add(top);
        std::reverse(bottom.begin(), bottom.end());
        add(bottom);
    }

    // Between two convex loops in one plane, the inner one inside the outer one; both counter-clockwise.
    void add_ring(const Polygon& outer, const Polygon& inner) {
        Vec3 normal = Vec3::Zero();
        for (std::size_t i = 0; i < outer.size(); ++i) {
            normal += outer[i].cross(outer[(i + 1) % outer.size()]);
        }
        const auto left = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
            return (b - a).cross(c - a).dot(normal) > 0;
        };
        std::size_t i = 0;
        std::size_t j = 0;
        for (std::size_t k = 0; k < inner.size(); ++k) {
            j = (inner[k] - outer[0]).norm() < (inner[j] - outer[0]).norm() ? k : j;
        }
        for (std::size_t a = 0, b = 0; a < outer.size() || b < inner.size();) {
            const Vec3& o = outer[i % outer.size()];
            const Vec3& o1 = outer[(i + 1) % outer.size()];
            const Vec3& n = inner[j % inner.size()];
            const Vec3& n1 = inner[(j + 1) % inner.size()];
            const bool inward = b < inner.size() && left(n1, n, o) && (a == outer.size() || left(o, o1, n1));
            inward ? add({o, n1, n}) : add({o, o1, n});
            inward ? (++j, ++b) : (++i, ++a);
        }
    }

    [[nodiscard]] TaggedSurface triangles() const {
        TaggedSurface surface;
        surface.mesh.nodes = points_;
        std::vector<Index> fresh(points_.size(), pavior::no_index);
        surface.mesh.nodes.clear();
        for (const auto& [key, face] : faces_) {
            std::vector<Index> ids;
            for (const Index i : face) {
                if (fresh[i] == pavior::no_index) {
                    fresh[i] = static_cast<Index>(surface.mesh.nodes.size());
                    surface.mesh.nodes.push_back(points_[i]);
                }
                ids.push_back(fresh[i]);
            }
            for (std::size_t k = 1; k + 1 < ids.size(); ++k) {
                surface.mesh.triangles.push_back({ids[0], ids[k], ids[k + 1]});
            }
        }
        return surface;
    }

private:
    Index weld(const Vec3& x) {
        const std::array<long, 3> key{std::lround(1e9 * x[0]), std::lround(1e9 * x[1]), std::lround(1e9 * x[2])};
        const auto [at, fresh] = ids_.try_emplace(key, static_cast<Index>(points_.size()));
        if (fresh) {
            points_.push_back(x);
        }
        return at->second;
    }

    std::map<std::array<long, 3>, Index> ids_;
    std::vector<Vec3> points_;
    std::map<std::vector<Index>, std::vector<Index>> faces_;
};

Polygon lifted(Polygon polygon, const Vec3& by) {
    for (Vec3& x : polygon) {
        x += by;
    }
    return polygon;
}

Polygon reversed(Polygon polygon) {
    std::reverse(polygon.begin(), polygon.end());
    return polygon;
}

Polygon rectangle(double x0, double x1, double y0, double y1, double z) {
    return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

TaggedSurface brick() {
    Surface s;
    s.add_prism(rectangle(0, 3, 0, 2, 0), rectangle(0.4, 2.6, 0.3, 1.7, 1.5));
    return s.triangles();
}

TaggedSurface rounded_l() {
    Surface s;
    const Vec3 up(0, 0, 1);
    Polygon corner{{1, 1, 0}, {0, 1, 0}};
    for (int i = 0; i <= 6; ++i) {
        const double a = pi / 12 * i;
        corner.emplace_back(0.7 - 0.7 * std::cos(a), 0.7 - 0.7 * std::sin(a), 0);
    }
    corner.emplace_back(1, 0, 0);
    for (const Polygon& p : {rectangle(1, 3, 0, 1, 0), rectangle(0, 1, 1, 3, 0), corner}) {
        s.add_prism(p, lifted(p, up));
    }
    return s.triangles();
}

// A plate with an upright triangular prism on the top and another on the bottom.
TaggedSurface protrusions() {
    Surface s;
    const auto prism = [&](const Polygon& plate, const Polygon& foot, const Vec3& height) {
        s.add_ring(plate, foot);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& a = foot[i];
            const Vec3& b = foot[(i + 1) % 3];
            s.add({a, b, b + height, a + height});
        }
        s.add(lifted(foot, height));
    };
    prism(rectangle(0, 8, 0, 4, 1), {{1, 1.1, 1}, {1.8, 0.7, 1}, {1.6, 1.9, 1}}, {0, 0, 0.8});
    prism(reversed(rectangle(0, 8, 0, 4, 0)), {{6, 3, 0}, {7, 3, 0}, {6.5, 2, 0}}, {0, 0, -0.8});
    const Polygon base = rectangle(0, 8, 0, 4, 0);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 up(0, 0, 1);
        s.add({base[i], base[(i + 1) % 4], base[(i + 1) % 4] + up, base[i] + up});
    }
    return s.triangles();
}

// Half a gear of six teeth with a raised hub.
TaggedSurface half_gear() {
    Surface s;
    const auto sector = [&](int step, double r0, double r1, double z0, double z1) {
        const auto at = [&](int k, double r, double z) {
            return Vec3(r * std::cos(pi / 36 * k), r * std::sin(pi / 36 * k), z);
        };
        const Polygon bottom{at(step, r0, z0), at(step, r1, z0), at(step + 1, r1, z0), at(step + 1, r0, z0)};
        const Polygon top{at(step, r0, z1), at(step, r1, z1), at(step + 1, r1, z1), at(step + 1, r0, z1)};
        s.add_prism(bottom, top);
    };
    for (int step = 0; step < 36; ++step) {
        sector(step, 1.0, 1.6, 0.0, 0.6);
        sector(step, 1.0, 1.6, 0.6, 1.2);
        sector(step, 1.6, 2.4, 0.0, 0.6);
        if (step % 6 < 3) {
            sector(step, 2.4, 3.0, 0.0, 0.6);
        }
    }
    return s.triangles();
}

// A thin plate with rounded corners and two square holes, bent about an axis.
TaggedSurface plate_with_holes() {
    constexpr double length = 5;
    constexpr double width = 3;
    constexpr double radius = 0.6;
    Surface s;
    const auto bent = [](double x, double y, double r) {
        const double a = (x - length / 2) / 6;
        return Vec3(r * std::sin(a), y, r * std::cos(a));
    };
    const auto cell = [&](double x0, double x1, double low0, double low1, double high0, double high1) {
        const auto polygon = [&](double r) {
            return Polygon{bent(x0, low0, r), bent(x1, low1, r), bent(x1, high1, r), bent(x0, high0, r)};
        };
        s.add_prism(polygon(6.0), polygon(6.15));
    };
    const auto inset = [&](double x) {  // of the rounded corners
        const double d = std::max(0.0, radius - std::min(x, length - x));
        return radius - std::sqrt(radius * radius - d * d);
    };
    std::vector<double> xs;
    for (int i = 0; i <= 6; ++i) {
        xs.push_back(radius - radius * std::cos(pi / 12 * i));
    }
    xs.insert(xs.end(), {0.8, 1.0, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5});
    for (std::size_t i = xs.size() - 1; i-- > 0;) {
        xs.push_back(length - xs[i]);
    }
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const double x0 = xs[i];
        const double x1 = xs[i + 1];
        const bool hole = (x0 >= 1 && x1 <= 2) || (x0 >= 3 && x1 <= 4);
        cell(x0, x1, inset(x0), inset(x1), 1, 1);
        if (!hole) {
            cell(x0, x1, 1, 1, 2, 2);
        }
        cell(x0, x1, 2, 2, width - inset(x0), width - inset(x1));
    }
    return s.triangles();
}

// A square tube along the edges of a cube, through all of its corners, rounded where it turns.
TaggedSurface closed_loop() {
    constexpr double edge = 3;
    constexpr double half = 0.5;
    const std::vector<Vec3> path{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}};
    Surface s;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Vec3& here = path[i];
        const Vec3 in = here - path[(i + path.size() - 1) % path.size()];
        const Vec3 out = path[(i + 1) % path.size()] - here;
        const Vec3 side = in.cross(out);
        const Vec3 pivot = edge * here - half * in + half * out - half * side;
        Polygon elbow{pivot};
        for (int k = 0; k <= 4; ++k) {
            const double a = pi / 8 * k;
            const double c = k == 4 ? 0.0 : std::cos(a);
            elbow.push_back(pivot - 2 * half * (c * out - (k == 0 ? 0.0 : std::sin(a)) * in));
        }
        s.add_prism(elbow, lifted(elbow, 2 * half * side));
        const Polygon end{pivot, elbow.back(), elbow.back() + 2 * half * side, pivot + 2 * half * side};
        s.add_prism(end, lifted(end, (edge - 2 * half) * out));
    }
    return s.triangles();
}

TaggedSurface pyramid_on_box() {
    Surface s;
    const Polygon base = rectangle(0, 3, 0, 3, 0);
    const Polygon foot = rectangle(1, 2, 1, 2, 1);
    const Vec3 up(0, 0, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        s.add({base[i], base[(i + 1) % 4], base[(i + 1) % 4] + up, base[i] + up});
        s.add({foot[i], foot[(i + 1) % 4], {1.5, 1.5, 1.8}});
    }
    s.add(reversed(base));
    s.add_ring(lifted(base, up), foot);
    return s.triangles();
}

struct Row {
    std::size_t nodes = 0;
    std::size_t elements = 0;
};

struct Example {
    const char* name;
    const char* table;
    TaggedSurface (*surface)();
    Row thesis[4];       // reference mesh, dual surfaces, dual regions, block mesh
    const char* remark;  // where the thesis' figure is impossible
};

const Example examples[] = {
    {"Brick-shaped domain", "5.2", brick, {{16, 21}, {336, 406}, {368, 315}, {27, 8}}, nullptr},
    {"L-shaped domain",
     "5.3",
     rounded_l,
     {{52, 88}, {1198, 1374}, {1460, 1320}, {50, 22}},
     "50 nodes are impossible: a ball cut into C cells by E chains has 2 E + 1 + 2 C block nodes, an odd number"},
    {"Non-sweepable protrusions",
     "5.4",
     protrusions,
     {{57, 114}, {1750, 1374}, {1807, 1710}, {260, 132}},
     "260 nodes are impossible for the same reason, and 1374 polygons are those of table 5.3"},
    {"Half of a gear", "5.5", half_gear, {{513, 1229}, {16697, 20966}, {18840, 18435}, {633, 336}}, nullptr},
    {"Thin domain with holes",
     "5.6",
     plate_with_holes,
     {{391, 1052}, {13445, 15657}, {15764, 15780}, {201, 96}},
     nullptr},
    {"Closed loop", "5.7", closed_loop, {{303, 579}, {7527, 8626}, {9372, 8685}, {240, 112}}, nullptr},
    {"4-valent protrusion", "5.8", pyramid_on_box, {{33, 56}, {891, 1312}, {924, 840}, {177, 92}}, nullptr},
};

bool run(const Example& example, const std::string& directory) {
    const TaggedSurface surface = example.surface();
    const pavior::ReferenceMesh reference = pavior::make_reference_mesh(pavior::tetrahedralize(surface));
    const pavior::SolidBlocks solid = pavior::block_solid(reference);
    const auto contributions = pavior::add_contributions(solid.reference, solid.topology, solid.classes);
    const auto regions = pavior::regions(solid.reference, solid.topology, contributions);
    const auto surfaces = pavior::dual_surfaces(solid.reference, solid.topology, contributions);
    const auto polyhedra = pavior::region_polyhedra(solid.reference, solid.topology, regions);
    const Row ours[4] = {{solid.reference.nodes.size(), solid.reference.tets.size()},
                         {surfaces.points.size(), surfaces.colour.size()},
                         {polyhedra.points.size(), polyhedra.region.size()},
                         {solid.blocks.nodes.size(), solid.blocks.hexes.size()}};
    std::printf("%s (table %s)\n                     ours               thesis\n", example.name, example.table);
    std::printf("                  nodes  elements    nodes  elements\n");
    const char* const names[4] = {"reference mesh", "dual surfaces", "dual regions", "block mesh"};
    for (std::size_t i = 0; i < 4; ++i) {
        std::printf("  %-14s %6zu   %7zu   %6zu   %7zu\n", names[i], ours[i].nodes, ours[i].elements,
                    example.thesis[i].nodes, example.thesis[i].elements);
    }
    const bool valid = solid.report.status == pavior::BlockStatus::valid;
    std::printf("  %s; %zu sheets; smallest scaled Jacobian %.2f\n", valid ? "valid" : "NOT VALID",
                solid.report.blocks.sheets, solid.placement.min_jacobian);
    if (example.remark != nullptr) {
        std::printf("  %s\n", example.remark);
    }
    std::printf("\n");
    if (!directory.empty()) {
        std::ofstream file(directory + "/" + example.table + ".off");
        file.precision(17);
        file << "OFF\n" << surface.mesh.nodes.size() << " " << surface.mesh.triangles.size() << " 0\n";
        for (const Vec3& x : surface.mesh.nodes) {
            file << x[0] << " " << x[1] << " " << x[2] << "\n";
        }
        for (const auto& c : surface.mesh.triangles) {
            file << "3 " << c[0] << " " << c[1] << " " << c[2] << "\n";
        }
    }
    const bool impossible = example.remark != nullptr;
    return valid && ours[3].elements == example.thesis[3].elements &&
           (impossible || ours[3].nodes == example.thesis[3].nodes);
}

}  // namespace

int main(int argc, char** argv) {
    bool all = true;
    for (const Example& example : examples) {
        all = run(example, argc > 1 ? argv[1] : "") && all;
    }
    std::printf("%s\n", all ? "all block meshes have the counts of the thesis" : "SOME BLOCK MESHES DIFFER");
    return all ? 0 : 1;
}

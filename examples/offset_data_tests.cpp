// The four tests of section 3.5 (Roca 2009): how four affine maps keep the offset data of the caps.
//
// A square of N x N quads is swept in an advancing front, without boundary correction, as in the thesis. Three sweeps
// are straight, with loops whose curvature changes along the path; the fourth follows a circular path. Printed are the
// statistics of f_shape (harmonic mean of the eight corner mean ratios) and how the node in the middle fares.
#include <pavior/mesh/quality.hpp>
#include <pavior/sweep/sweep.hpp>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using pavior::AffineMethod;
using pavior::Index;
using pavior::Vec3;

namespace {

const double pi = std::acos(-1.0);

struct Test {
    std::string name;
    Index cells;            // N
    std::size_t layers;     // r
    double c0, cr;          // curvature of the loops: z = c x^2
    double angle0, angler;  // degrees between the two edges at the middle node of each cap
    bool circular;          // a circular path of radius 3 through 120 degrees, planar loops, caps that bulge outwards
};

// Height of the bump that gives the wanted angle at the middle node.
double bump_height(double degrees, double c, Index cells) {
    const double h = 2.0 / cells;
    const double b = std::cos(pi * h / 2) * std::cos(pi * h / 2);
    return (h * std::tan((180 - degrees) / 2 * pi / 180) + c * h * h) / (1 - b);
}

pavior::SweepProblem make_problem(const Test& test) {
    const Index n = test.cells;
    const auto bump = [](double x, double y) { return std::pow(std::cos(pi * x / 2) * std::cos(pi * y / 2), 2); };
    const double d0 = test.circular ? -0.5 : bump_height(test.angle0, test.c0, n);
    const double dr = test.circular ? 0.5 : bump_height(test.angler, test.cr, n);
    const auto place = [&](double x, double y, double t) {
        const double z = ((1 - t) * test.c0 + t * test.cr) * x * x;
        return Vec3(x, y, 2.4 * t + z);
    };
    const auto turn = [](const Vec3& local, double t) {
        const double angle = 2 * pi / 3 * t;
        return Vec3((3 + local[0]) * std::cos(angle) - local[2] * std::sin(angle), local[1],
                    (3 + local[0]) * std::sin(angle) + local[2] * std::cos(angle));
    };
    const auto node = [&](double x, double y, double t, double height) {
        if (test.circular) {
            return turn(Vec3(x, y, height * bump(x, y)), t);
        }
        return Vec3(place(x, y, t) + Vec3(0, 0, height * bump(x, y)));
    };
    pavior::QuadMesh source;
    std::vector<Vec3> target;
    for (Index j = 0; j <= n; ++j) {
        for (Index i = 0; i <= n; ++i) {
            const double x = 2.0 * i / n - 1;
            const double y = 2.0 * j / n - 1;
            source.nodes.push_back(node(x, y, 0, d0));
            target.push_back(node(x, y, 1, dr));
            if (i < n && j < n) {
                const Index a = j * (n + 1) + i;
                source.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
            }
        }
    }
    const pavior::Loops loops = boundary_loops(source);
    std::vector<std::vector<Vec3>> levels(test.layers + 1);
    for (std::size_t k = 0; k <= test.layers; ++k) {
        for (const Index i : loops.nodes) {
            const double t = static_cast<double>(k) / static_cast<double>(test.layers);
            levels[k].push_back(node(2.0 * (i % (n + 1)) / n - 1, 2.0 * (i / (n + 1)) / n - 1, t, 0));
        }
    }
    for (std::size_t i = 0; i < loops.nodes.size(); ++i) {
        source.nodes[loops.nodes[i]] = levels.front()[i];
        target[loops.nodes[i]] = levels.back()[i];
    }
    return make_sweep_problem(source, target, loops, levels);
}

// Angle (degrees) between the edges to both neighbours in x at the middle node of a level.
double middle_angle(const pavior::SweepMesh& mesh, std::size_t k, Index n) {
    const auto level = mesh.level(k);
    const std::size_t middle = (n / 2) * (n + 1) + n / 2;
    const Vec3 a = level[middle - 1] - level[middle];
    const Vec3 b = level[middle + 1] - level[middle];
    const double angle = std::acos(a.dot(b) / (a.norm() * b.norm())) * 180 / pi;
    const bool dented = (a.normalized() + b.normalized())[2] > 0;  // curved towards the bottom
    return dented ? 360 - angle : angle;
}

double middle_distance(const pavior::SweepMesh& mesh, std::size_t k, Index n) {
    const std::size_t middle = (n / 2) * (n + 1) + n / 2;
    return (mesh.level(k + 1)[middle] - mesh.level(k)[middle]).norm();
}

void run(const Test& test, AffineMethod method) {
    pavior::SweepOptions options;
    options.method = method;
    options.strategy = pavior::SweepStrategy::front;
    options.correction = pavior::BoundaryCorrection::none;
    const auto mesh = sweep(make_problem(test), options).mesh;
    const auto f_shape = hex_quality(mesh).f_shape;
    std::printf("%-15s %-12s %6.4f %6.4f %6.4f %6.4f  ", test.name.c_str(), std::string(to_string(method)).c_str(),
                f_shape.min, f_shape.max, f_shape.mean, f_shape.stddev);
    for (std::size_t i = 0; i <= 4; ++i) {
        if (test.circular) {
            std::printf(" %6.4f", middle_distance(mesh, i * (test.layers - 1) / 4, test.cells));
        } else {
            std::printf(" %6.1f", middle_angle(mesh, i * test.layers / 4, test.cells));
        }
    }
    std::printf("\n");
}

}  // namespace

int main() {
    const Test tests[] = {{"flattening", 10, 12, -0.05, 0.15, 160, 155, false},
                          {"flipping", 10, 12, -0.025, 0.15, 169.5, 163.5, false},
                          {"offset scaling", 10, 12, -0.02, -0.24, 166, 160, false},
                          {"skewing", 6, 16, 0, 0, 0, 0, true}};
    std::printf(
        "test            map          min    max    mean   std     middle node along the sweep: angle"
        " (skewing: distance)\n");
    for (const Test& test : tests) {
        for (const auto method : {AffineMethod::f, AffineMethod::g, AffineMethod::h, AffineMethod::constrained}) {
            run(test, method);
        }
    }
}

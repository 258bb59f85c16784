// Random machined parts through `pavior mesh`: a block of material with holes, pockets, slots, steps and chamfers, from
// one side or from several. Each is meshed or refused with a reason; no mesh that is written may be wrong. With
// PAVIOR_PARTS=first:count in the environment other seeds are tried. Each seed is printed with what came of it.
#include "support/catch.hpp"
#include "support/dice.hpp"
#include "support/occ_solids.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// On a grid of 0.05.
double grid(Dice& dice, double low, double high) { return std::round(dice.real(low, high) * 20) / 20; }

using Point = std::array<double, 2>;

/// The outline of a feature on a side of width w; empty for a round one.
std::vector<Point> outline(Dice& dice, double w, const Point& at) {
    const double a = grid(dice, 1.5, 2.5);
    const double b = grid(dice, 1.5, 2.5);
    switch (dice.below(6)) {
        case 0: return {at, {at[0] + a, at[1]}, {at[0] + a, at[1] + b}, {at[0], at[1] + b}};
        case 1: return {at, {at[0] + a, at[1]}, {at[0] + a / 2, at[1] + b}};
        case 2: {
            std::vector<Point> hexagon;
            for (int i = 0; i < 6; ++i) {
                const double angle = i * std::numbers::pi / 3;
                hexagon.push_back({at[0] + 1 + std::cos(angle), at[1] + 1 + std::sin(angle)});
            }
            return hexagon;
        }
        case 3: return {{-1, at[1]}, {w + 1, at[1]}, {w + 1, at[1] + b}, {-1, at[1] + b}};  // a slot or step
        case 4: return {{-1, -1}, {a + 1 + a / b, -1}, {-1, b + 1 + b / a}};                // a chamfer
        default: return {};
    }
}

/// The material that a feature takes away, from one side of the block of \p size along an axis.
gmsh::vectorpair feature(Dice& dice, const std::array<double, 3>& size, std::size_t axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const double length = size[axis];
    const bool far_side = dice.coin();
    const bool through = dice.coin();
    const double depth = through ? length + 1 : grid(dice, 1, 0.6 * length);
    const double base = far_side ? length - depth : -1;
    const auto place = [&](const Point& p, double height) {
        std::array<double, 3> x{};
        x[axis] = height;
        x[u] = p[0];
        x[v] = p[1];
        return x;
    };
    const Point at{grid(dice, 1, size[u] - 3.5), grid(dice, 1, size[v] - 3.5)};
    const std::array<double, 3> along = place({0, 0}, depth + 1);
    const std::vector<Point> corners = outline(dice, size[u], at);
    if (corners.empty()) {
        const auto c = place({at[0] + 1, at[1] + 1}, base);
        return {{3, occ::addCylinder(c[0], c[1], c[2], along[0], along[1], along[2], grid(dice, 0.5, 1))}};
    }
    std::vector<int> points;
    std::vector<int> lines;
    for (const Point& p : corners) {
        const auto x = place(p, base);
        points.push_back(occ::addPoint(x[0], x[1], x[2]));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
    }
    gmsh::vectorpair out;
    occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(lines)})}}, along[0], along[1], along[2], out);
    return {out.at(1)};
}

/// A part that has been written.
struct Part {
    std::size_t solids = 0;  ///< more than one if the features have cut it apart
    double volume = 0;
    double round_area = 0;  ///< of its round faces, whose radii are 1 at most
};

/// Writes the part of a seed.
Part write_part(unsigned seed, const std::string& file) {
    Dice dice(seed);
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    const std::array<double, 3> size{grid(dice, 8, 12), grid(dice, 8, 12), grid(dice, 6, 10)};
    gmsh::vectorpair solid{{3, occ::addBox(0, 0, 0, size[0], size[1], size[2])}};
    const int count = 1 + dice.below(4);
    const bool one_side = dice.coin();
    for (int i = 0; i < count; ++i) {
        const std::size_t axis = one_side ? 2 : static_cast<std::size_t>(dice.below(3));
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        occ::cut(solid, feature(dice, size, axis), out, map);
        solid = out;
    }
    occ::synchronize();
    gmsh::write(file);
    Part part{solid.size(), 0, 0};
    occ::getMass(3, solid.at(0).second, part.volume);
    gmsh::vectorpair faces;
    gmsh::model::getEntities(faces, 2);
    for (const auto& [dimension, tag] : faces) {
        std::string kind;
        gmsh::model::getType(dimension, tag, kind);
        if (kind != "Plane") {
            double area = 0;
            occ::getMass(dimension, tag, area);
            part.round_area += area;
        }
    }
    gmsh::finalize();
    return part;
}

/// What chords, so many to a circle at least, can add to the volume or cut off.
double chord_volume(const Part& part, int chords) {
    return 2.0 / 3 * (1 - std::cos(std::numbers::pi / chords)) * part.round_area;
}

}  // namespace

TEST_CASE("random machined parts are meshed, or refused with a reason") {
    const Seeds range = seeds("PAVIOR_PARTS", 6);
    const std::string file = scratch_file("part.brep");
    const std::string mesh = scratch_file("part.vtu");
    const std::string report = scratch_file("part.json");
    std::array<unsigned, 4> totals{};  // by exit code
    std::vector<std::string> methods;
    for (unsigned seed = range.first; seed <= range.last(); ++seed) {
        CAPTURE(seed);
        const Part part = write_part(seed, file);
        if (part.solids != 1) {
            methods.emplace_back("cut apart");
            continue;
        }
        std::filesystem::remove(mesh);
        const ProgramRun run =
            run_program("mesh " + file + " --size 1 -o " + mesh + " --report " + report + " --quiet");
        REQUIRE((run.code == 0 || run.code == 1 || run.code == 3));
        ++totals[static_cast<std::size_t>(run.code)];
        const auto json = json_of(report);
        std::cerr << "part " << seed << " exit " << run.code;
        CHECK(std::filesystem::exists(mesh) == (run.code == 0));
        if (run.code == 0) {
            const double jacobian = json["mesh"]["quality"]["scaled_jacobian"]["min"];
            methods.push_back(json["decisions"][0]["method"]);
            std::cerr << ": " << methods.back() << ", " << jacobian;
            CHECK(jacobian > 0);
            const int chords = methods.back() == "block" ? 4 : 8;  // blocks have no least number of nodes on a loop
            const HexReport checked = verify_hexes(read_mesh(mesh).mesh);
            CHECK(checked.ok());
            CHECK(std::abs(checked.volume - part.volume) <= chord_volume(part, chords) + 1e-9 * part.volume);
        } else {
            methods.emplace_back("none");
            CHECK(run.err.find(run.code == 1 ? "not valid" : "not meshable") != std::string::npos);
        }
        std::cerr << "\n";
    }
    std::cerr << totals[0] << " parts meshed, " << totals[1] << " meshes not valid, " << totals[3] << " refused\n";
    if (std::getenv("PAVIOR_PARTS") == nullptr) {
        const std::vector<std::string> wanted{"multi-sweep", "sweep", "cut apart",
                                              "multi-sweep", "sweep", "multi-sweep"};
        CHECK(methods == wanted);
    } else {
        CHECK(3 * totals[0] >= 2 * (totals[0] + totals[1] + totals[3]));
    }
}

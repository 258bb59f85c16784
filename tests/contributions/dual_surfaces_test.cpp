#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/contributions/dual_surfaces.hpp>

#include <map>
#include <set>

using namespace pavior;

namespace {
struct Dual {
    ReferenceMesh mesh;
    TetTopology topology;
    std::vector<TetContributions> contributions;
    Regions regions;
};
Dual make(ReferenceMesh mesh, VertexRule rule = VertexRule::repaired) {
    Dual d{std::move(mesh), {}, {}, {}};
    d.topology = tet_topology(d.mesh);
    d.contributions = add_contributions(d.mesh, d.topology, classify(d.mesh, d.topology), rule);
    d.regions = regions(d.mesh, d.topology, d.contributions);
    return d;
}

double volume(const RegionPolyhedra& p, std::size_t cell) {
    // Flux through the faces, which are planar.
    static const std::map<std::size_t, std::vector<std::vector<std::size_t>>> faces{
        {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
        {6, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
        {8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};
    double sum = 0.0;
    for (const auto& face : faces.at(p.begin[cell + 1] - p.begin[cell])) {
        const auto x = [&](std::size_t k) { return p.points[p.ids[p.begin[cell] + face[k]]]; };
        const Vec3 normal = (x(1) - x(0)).cross(x(2) - x(0));
        for (std::size_t k = 3; k < face.size(); ++k) {  // planar
            CHECK(std::abs(normal.dot(x(k) - x(0))) < 1e-12);
        }
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            sum += x(0).dot(x(k).cross(x(k + 1))) / 6.0;
        }
    }
    return sum;
}
}  // namespace

TEST_CASE("tables 5.2 and 5.8, and a cap under both rules") {
    for (const char* name : {"ref_brick_table52", "ref_pyramid_table58"}) {
        const tet_meshes::ReferenceFile file = tet_meshes::read_reference(name);
        const Dual d = make(file.mesh);
        const DualSurfaces surfaces = dual_surfaces(d.mesh, d.topology, d.contributions);
        CHECK(surfaces.points.size() == file.expected.at("dual_nodes"));
        CHECK(surfaces.size() == file.expected.at("dual_polygons"));
        const RegionPolyhedra regions = region_polyhedra(d.mesh, d.topology, d.regions);
        CHECK(regions.points.size() == file.expected.at("region_nodes"));
        CHECK(regions.size() == file.expected.at("region_polyhedra"));
        CHECK(d.regions.count() == file.expected.at("nodes"));
    }
    const tet_meshes::ReferenceFile file = tet_meshes::read_reference("ref_bug58");
    CHECK(make(file.mesh).regions.count() == file.expected.at("nodes_repaired"));
    CHECK(make(file.mesh, VertexRule::printed).regions.count() == file.expected.at("nodes_literal"));
}

TEST_CASE("identities of the counts; pieces fill the solid, those of one region once each") {
    std::mt19937 random(20);
    for (int n = 0; n < 12; ++n) {
        const ReferenceMesh mesh =
            tet_meshes::reference(tet_meshes::random_solid({3, 3, 2}, random), 1 + static_cast<Index>(n % 2));
        const Dual d = make(mesh);
        const RegionPolyhedra pieces = region_polyhedra(d.mesh, d.topology, d.regions, 0.2);
        CHECK(pieces.points.size() ==
              mesh.nodes.size() + 2 * d.topology.edges.size() + 3 * d.topology.faces.size() + 4 * mesh.tets.size());
        CHECK(pieces.size() == 15 * mesh.tets.size());
        double sum = 0.0;
        bool positive = true;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const double v = volume(pieces, i);
            positive = positive && v > 0.0;
            sum += v;
        }
        CHECK(positive);
        double wanted = 0.0;
        for (const TetCorners& c : mesh.tets) {
            const Vec3 x = mesh.nodes[c[0]];
            wanted += (mesh.nodes[c[1]] - x).cross(mesh.nodes[c[2]] - x).dot(mesh.nodes[c[3]] - x) / 6.0;
        }
        CHECK(sum == Approx(wanted));
        CHECK(std::set<Index>(pieces.region.begin(), pieces.region.end()).size() == d.regions.count());
        CHECK(dual_surfaces(d.mesh, d.topology, d.contributions).size() <= 28 * mesh.tets.size());
    }
}

TEST_CASE("polygons separate regions: two pieces on the two sides, of one region only where soft or none") {
    const Dual d = make(tet_meshes::reference(tet_meshes::box(2, 1, 1)));
    const DualSurfaces surfaces = dual_surfaces(archetype::Tets(d.mesh), d.topology, d.contributions, 0.1);
    std::map<DualColour, std::size_t> colours;
    for (const DualColour c : surfaces.colour) {
        ++colours[c];
    }
    CHECK(colours[DualColour::red] == 24);  // two boxes with 12 triangles each
    CHECK(colours[DualColour::yellow] > 0);
    std::map<DualColour, std::size_t> wanted;
    for (std::size_t t = 0; t < d.mesh.tets.size(); ++t) {
        for (std::size_t i = 0; i < candidate_count; ++i) {
            const Candidate& c = tet_candidates[i];
            const Regions& r = d.regions;
            const Index face = r.face[d.topology.tet_faces[t][c.kind == CandidateKind::face ? c.entity : c.other % 4]];
            const Index edge = r.edge[d.topology.tet_edges[t][c.kind == CandidateKind::edge ? c.entity : c.other]];
            const Index one = c.kind == CandidateKind::face ? r.tet[t] : edge;
            const Index two = c.kind == CandidateKind::vertex ? r.node[d.mesh.tets[t][c.entity]] : face;
            switch (d.contributions[t][i]) {
                case Contribution::none: CHECK(one == two); continue;
                case Contribution::soft: break;
                case Contribution::hard: CHECK(one != two); break;
            }
            ++wanted[dual_colour(c.kind, d.contributions[t][i])];
        }
    }
    CHECK(colours == wanted);
    CHECK(surfaces.tet.size() == surfaces.size());
}

TEST_CASE("colours; mu out of range") {
    CHECK(dual_colour(CandidateKind::face, Contribution::hard) == DualColour::red);
    CHECK(dual_colour(CandidateKind::edge, Contribution::hard) == DualColour::orange);
    CHECK(dual_colour(CandidateKind::edge, Contribution::soft) == DualColour::cyan);
    CHECK(dual_colour(CandidateKind::vertex, Contribution::hard) == DualColour::yellow);
    CHECK(dual_colour(CandidateKind::vertex, Contribution::soft) == DualColour::blue);
    std::set<std::array<double, 3>> all;
    for (const DualColour c :
         {DualColour::red, DualColour::orange, DualColour::cyan, DualColour::yellow, DualColour::blue}) {
        all.insert(rgb(c));
    }
    CHECK(all.size() == 5);
    const Dual d = make(tet_meshes::reference(tet_meshes::box(1, 1, 1)));
    for (const double mu : {0.0, 0.25, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
        CHECK_THROWS_AS(dual_surfaces(d.mesh, d.topology, d.contributions, mu), InputError);
        CHECK_THROWS_AS(region_polyhedra(d.mesh, d.topology, d.regions, mu), InputError);
    }
}

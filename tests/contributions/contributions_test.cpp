#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/contributions/contributions.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>

using namespace pavior;

static_assert(sizeof(TetContributions) == 8);

namespace {

/// The candidates by name, written out from the numbering that candidates.hpp promises: c(f; t) by the nodes of f,
/// c(e; f; t) as e/f, c(v; e; t) as v/e.
constexpr std::array<const char*, candidate_count> names{"123",    "023",    "013",    "012",                         //
                                                         "01/013", "01/012", "02/023", "02/012", "03/023", "03/013",  //
                                                         "12/123", "12/012", "13/123", "13/013", "23/123", "23/023",  //
                                                         "0/01",   "1/01",   "0/02",   "2/02",   "0/03",   "3/03",    //
                                                         "1/12",   "2/12",   "1/13",   "3/13",   "2/23",   "3/23"};

using Classes = std::map<std::string, EntityClass>;

/// n, s or h for each candidate, with blanks between edges.
std::string letters(TetContributions c) {
    std::string text;
    for (std::size_t i = 0; i < candidate_count; ++i) {
        text += (i == 4 || i == 16 || (i > 4 && i % 2 == 0)) ? " " : "";
        text += "nsh"[static_cast<std::size_t>(c[i])];
    }
    return text;
}

/// What Algorithms 5.3 to 5.5 add to a tetrahedron; what has no class is free.
std::string added(Classes classes, VertexRule rule = VertexRule::repaired) {
    TetContributions c;
    add_from_faces({classes["123"], classes["023"], classes["013"], classes["012"]}, c);
    const std::array<EntityClass, 6> edges{classes["01"], classes["02"], classes["03"],
                                           classes["12"], classes["13"], classes["23"]};
    add_from_edges(edges, c);
    add_from_vertices({classes["0"], classes["1"], classes["2"], classes["3"]}, edges, rule, c);
    return letters(c);
}

/// Algorithms 5.6 to 5.8 as printed, by names: n, s or h for each.
std::map<std::string, char> as_printed(Classes& classes, VertexRule rule) {
    std::map<std::string, char> c;
    for (const std::string name : names) {  // faces before edges before nodes
        const std::string entity = name.substr(0, name.find('/'));
        const std::string other = name.substr(name.find('/') + 1);
        const EntityClass own = classes[entity];
        char type = 'n';
        if (entity.size() == 3) {
            type = own == EntityClass::layer ? 'h' : 'n';
        } else if (entity.size() == 2 && own != EntityClass::free) {
            const char in = own == EntityClass::stack ? 'h' : 'n';
            type = c[other] == 'n' ? 's' : in;
        } else if (entity.size() == 1 && own != EntityClass::free) {
            std::string both;  // of the edge
            for (const auto& [key, value] : c) {
                both += key.size() == 6 && key.substr(0, 2) == other ? std::string(1, value) : std::string();
            }
            const bool absent = both == "nn";
            const bool hard = both.find('h') != std::string::npos;
            if (own == EntityClass::layer) {
                const bool printed = rule == VertexRule::printed;
                type = (printed ? absent : classes[other] == EntityClass::free) ? 's' : 'n';
            } else {
                const char crossed = own == EntityClass::stack ? 'n' : 'h';
                type = hard ? crossed : 's';
            }
        }
        c[name] = type;
    }
    return c;
}

/// The classes of a tetrahedron of a mesh by names.
Classes classes_of(const TetCorners& t, const TetTopology& topology, const EntityClasses& classes) {
    Classes out;
    for (Index i = 0; i < 4; ++i) {
        out[std::to_string(i)] = classes.node[t[i]];
        for (Index j = i + 1; j < 4; ++j) {
            const std::string edge = std::to_string(i) + std::to_string(j);
            const std::array<Index, 2> ends{std::min(t[i], t[j]), std::max(t[i], t[j])};
            const auto e = std::find(topology.edges.begin(), topology.edges.end(), ends) - topology.edges.begin();
            out[edge] = classes.edge[static_cast<std::size_t>(e)];
            for (Index k = j + 1; k < 4; ++k) {
                out[edge + std::to_string(k)] = classes.face[topology.face({t[i], t[j], t[k]})];
            }
        }
    }
    return out;
}

constexpr auto layer = EntityClass::layer;
constexpr auto stack = EntityClass::stack;
constexpr auto hexahedron = EntityClass::hexahedron;

}  // namespace

TEST_CASE("28 candidates in 56 bits") {
    TetContributions c;
    CHECK(c.empty());
    for (std::size_t i = 0; i < candidate_count; ++i) {
        c.add(i, static_cast<Contribution>(i % 3));
        CHECK(c.has_hard() == (i >= 2));
        CHECK(c.has_hard_vertex() == (i >= 17));
    }
    for (std::size_t i = 0; i < candidate_count; ++i) {
        CHECK(c[i] == static_cast<Contribution>(i % 3));
    }
}

TEST_CASE("the tetrahedron alone in the world") {
    // All its faces are layers, its edges stacks, its nodes hexahedra: all candidates are hard.
    ReferenceMesh mesh;
    mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    mesh.tets = {{0, 1, 2, 3}};
    mesh = make_reference_mesh(mesh);
    const TetTopology topology = tet_topology(mesh);
    const auto all = add_contributions(mesh, topology, classify(mesh, topology));
    REQUIRE(all.size() == 1);
    CHECK(letters(all[0]) == "hhhh hh hh hh hh hh hh hh hh hh hh hh hh");
}

TEST_CASE("contributions written down by hand from Algorithms 5.6 to 5.8") {
    CHECK(added({}) == "nnnn nn nn nn nn nn nn nn nn nn nn nn nn");
    // On a node of the boundary only: cut off from it.
    CHECK(added({{"0", layer}}) == "nnnn nn nn nn nn nn nn sn sn sn nn nn nn");
    // On a face of the boundary: the triangle, and soft ones that close it at the edges and nodes.
    CHECK(
        added(
            {{"123", layer}, {"12", layer}, {"13", layer}, {"23", layer}, {"1", layer}, {"2", layer}, {"3", layer}}) ==
        "hnnn nn nn nn ns ns ns ns ns ns nn nn nn");
    // Two faces that meet at a feature curve, which is crossed.
    CHECK(added({{"123", layer},
                 {"023", layer},
                 {"02", layer},
                 {"03", layer},
                 {"12", layer},
                 {"13", layer},
                 {"23", stack},
                 {"0", layer},
                 {"1", layer},
                 {"2", stack},
                 {"3", stack}}) == "hhnn nn ns ns ns ns hh ss ns ns ns ns nn");
    // A corner of a box with a dual point at node 0.
    CHECK(added({{"023", layer},
                 {"013", layer},
                 {"012", layer},
                 {"01", stack},
                 {"02", stack},
                 {"03", stack},
                 {"12", layer},
                 {"13", layer},
                 {"23", layer},
                 {"0", hexahedron},
                 {"1", stack},
                 {"2", stack},
                 {"3", stack}}) == "nhhh hh hh hh sn sn sn hn hn hn ss ss ss");
    // A cap of one tetrahedron on a face of the boundary: as printed, its node ends up in a region of its own.
    const Classes cap{{"023", layer}, {"013", layer}, {"012", layer}, {"01", layer}, {"02", layer},
                      {"03", layer},  {"12", layer},  {"13", layer},  {"23", layer}, {"0", layer},
                      {"1", layer},   {"2", layer},   {"3", layer}};
    CHECK(added(cap) == "nhhh nn nn nn sn sn sn nn nn nn nn nn nn");
    CHECK(added(cap, VertexRule::printed) == "nhhh nn nn nn sn sn sn ss ss ss nn nn nn");
}

TEST_CASE("every candidate follows the rules, on any mesh and any number of threads") {
    const ReferenceMesh mesh = tet_meshes::reference(
        tet_meshes::voxels({3, 3, 2}, [](Index i, Index j, Index k) { return i == 0 || j == 1 || k == 0; }), 3);
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    for (const VertexRule rule : {VertexRule::repaired, VertexRule::printed}) {
        const auto all = add_contributions(mesh, topology, classes, rule);
        REQUIRE(all.size() == mesh.tets.size());
        CHECK(all == add_contributions(archetype::Tets(mesh), topology, classes, rule, Execution{2}));
        std::map<char, std::size_t> count;
        std::size_t empty = 0;
        for (Index t = 0; t < all.size(); ++t) {
            Classes here = classes_of(mesh.tets[t], topology, classes);
            const auto wanted = as_printed(here, rule);
            empty += all[t].empty() ? 1 : 0;
            for (std::size_t i = 0; i < candidate_count; ++i) {
                const char type = "nsh"[static_cast<std::size_t>(all[t][i])];
                INFO("tetrahedron " << t << ", candidate " << names[i]);
                REQUIRE(type == wanted.at(names[i]));
                ++count[type];
            }
        }
        CHECK(count['h'] > 1000);
        CHECK(count['s'] > 1000);
        CHECK(empty > 0);
    }
}

#include "cad/step_names.hpp"

#include "cad/brep_checks.hpp"
#include "support/catch.hpp"
#include "support/scratch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/triangulation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

using namespace pavior;
using namespace pavior::test;

namespace {

std::string fault(const std::string& name) { return std::string(PAVIOR_TEST_DATA).append("/faults/").append(name); }

std::vector<std::string> solids(const GmshBrep& b) {
    std::vector<std::string> result;
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        result.push_back(b.solid_name(solid_id(s)));
    }
    return result;
}

using Names = std::vector<std::string>;

/// The text of a file of tests/data/faults with some words replaced.
std::string changed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& words) {
    std::ifstream file(fault(name), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const auto& [from, to] : words) {
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
    }
    return text;
}

std::string saved(const std::string& name, const std::string& text) {
    const std::string file = scratch_file(name);
    std::ofstream(file) << text;
    return file;
}

/// What is constant on a face, as "x=0": the face is in a plane across an axis.
std::string place(const GmshBrep& b, FaceId face) {
    std::array<Vec3, 2> box{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& use : loop) {
            for (const VertexId v : b.edge_vertices(use.edge)) {
                box[0] = box[0].cwiseMin(b.vertex_point(v));
                box[1] = box[1].cwiseMax(b.vertex_point(v));
            }
        }
    }
    for (const int axis : {0, 1, 2}) {
        if (box[1][axis] - box[0][axis] < 1e-6) {
            std::ostringstream text;
            text << "xyz"[axis] << "=" << std::round(1e6 * box[0][axis]) / 1e6;
            return text.str();
        }
    }
    return "?";
}

std::multiset<std::string> places_of(const GmshBrep& b, const std::string& name) {
    std::multiset<std::string> result;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        if (b.face_name(face_id(f)) == name) {
            result.insert(place(b, face_id(f)));
        }
    }
    return result;
}

/// pnames_slash.step with a third solid: the first part again, moved up by 10 and turned: x y z to y z x.
std::string with_copy() {
    return changed("pnames_slash.step",
                   {{"(#11,#15,#19)", "(#11,#15,#19,#905)"},
                    {"#39 = ADVANCED_FACE(''", "#39 = ADVANCED_FACE('in/let'"},
                    {"ENDSEC;\nEND-ISO",
                     "#900 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('46','','',#5,#31,$);\n"
                     "#901 = PRODUCT_DEFINITION_SHAPE('Placement','copy',#900);\n"
                     "#902 = ITEM_DEFINED_TRANSFORMATION('','',#11,#905);\n"
                     "#903 = ( REPRESENTATION_RELATIONSHIP('','',#36,#10) REPRESENTATION_RELATIONSHIP_WITH_"
                     "TRANSFORMATION(#902) SHAPE_REPRESENTATION_RELATIONSHIP() );\n"
                     "#904 = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#903,#901);\n"
                     "#905 = AXIS2_PLACEMENT_3D('',#906,#907,#908);\n#906 = CARTESIAN_POINT('',(0.,0.,10.));\n"
                     "#907 = DIRECTION('',(1.,0.,0.));\n#908 = DIRECTION('',(0.,1.,0.));\nENDSEC;\nEND-ISO"}});
}

}  // namespace

TEST_CASE("solids have the whole name of their product") {
    for (const bool imprint : {true, false}) {
        const CadOptions options{.imprint = imprint};
        CHECK(solids(GmshBrep::load(fault("pnames_slash.step"), options)) == Names{"alu/plate", "steel/plate"});
        CHECK(solids(GmshBrep::load(fault("pnames_same.step"), options)) == Names{"bolt", "bolt"});
        CHECK(solids(GmshBrep::load(fault("pnames_collide.step"), options)) == Names{"bolt-1", "bolt 1"});
        CHECK(solids(GmshBrep::load(fault("pnames_quote.step"), options)) == Names{"bolt \"M8\"", "it's"});
        CHECK(solids(GmshBrep::load(fault("pnames_face_clash.step"), options)) == Names{"face_3", "face_4"});
        CHECK(solids(GmshBrep::load(fault("partial_face.step"), options)) == Names{"", ""});
    }
}

TEST_CASE("solids and faces have their own names where the product has none") {
    for (const bool imprint : {true, false}) {
        const GmshBrep b = GmshBrep::load(fault("names_utf8.step"), CadOptions{.imprint = imprint});
        CHECK(solids(b) == Names{"Geh\xC3\xA4use \xC3\x98", "bolt-1"});
        CHECK(places_of(b, "\xE5\x85\xA5\xE5\x8F\xA3") == std::multiset<std::string>{"x=0"});
        CHECK(places_of(b, "wall").size() == 2);
        CHECK(places_of(b, "1inlet").size() == (imprint ? 2 : 1));
    }
}

TEST_CASE("pieces of a face keep its name, and other faces do not get it") {
    const GmshBrep b = GmshBrep::load(fault("names_utf8.step"));
    CHECK(places_of(b, "1inlet") == std::multiset<std::string>{"z=1", "z=1"});  // half of it under the other solid
    CHECK(places_of(b, "in let") == std::multiset<std::string>{"x=2"});
    CHECK(places_of(b, "in-let") == std::multiset<std::string>{"y=0"});
    CHECK(places_of(b, "wall") == std::multiset<std::string>{"y=2", "z=0"});
    CHECK(places_of(b, "").size() == 6);
}

TEST_CASE("names of faces go to the faces that the file means") {
    // A face in the plane x = 0 comes first in the file; the others are told by where they are.
    const GmshBrep b = GmshBrep::load(saved(
        "face.step", changed("pnames_slash.step", {{"#39 = ADVANCED_FACE(''", "#39 = ADVANCED_FACE('low x'"},
                                                   {"#159 = ADVANCED_FACE(''", "#159 = ADVANCED_FACE('high x'"}})));
    CHECK(places_of(b, "low x") == std::multiset<std::string>{"x=0"});
    CHECK(places_of(b, "high x").size() == 1);
    CHECK(places_of(b, "high x").begin()->rfind("x=", 0) == 0);
}

TEST_CASE("a part that is used twice has its names twice") {
    for (const bool imprint : {true, false}) {
        const GmshBrep b = GmshBrep::load(saved("copy.step", with_copy()), CadOptions{.imprint = imprint});
        Names names = solids(b);
        std::sort(names.begin(), names.end());
        CHECK(names == Names{"alu/plate", "alu/plate", "steel/plate"});
        CHECK(places_of(b, "in/let") == std::multiset<std::string>{"x=0", "y=0"});
    }
}

TEST_CASE("escapes of STEP are read, in labels too") {
    const auto text = changed("pnames_slash.step",
                              {{"PRODUCT('alu/plate','alu/plate'", "PRODUCT('a','Geh\\X2\\00E4\\X0\\use/\\X\\D8'"},
                               {"PRODUCT('steel/plate','steel/plate'", "PRODUCT('b','it''s a \\\\ plate'"}});
    CHECK(solids(GmshBrep::load(saved("escapes.step", text))) == Names{"Geh\xC3\xA4use/\xC3\x98", "it's a \\ plate"});
}

TEST_CASE("other units change no name") {
    const auto text = changed("names_utf8.step", {{"SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"},
                                                  {"SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"},
                                                  {"SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"}});
    const GmshBrep b = GmshBrep::load(saved("metres.step", text));
    CHECK(b.diagonal() > 1000);  // in millimetres
    CHECK(solids(b) == Names{"Geh\xC3\xA4use \xC3\x98", "bolt-1"});
    CHECK(places_of(b, "\xE5\x85\xA5\xE5\x8F\xA3") == std::multiset<std::string>{"x=0"});
}

TEST_CASE("faces of a surface model that is sewn keep their names") {
    // One box as faces alone; the other is no more.
    const auto text = changed(
        "names_utf8.step",
        {{"MANIFOLD_SOLID_BREP('Geh\xC3\xA4use \xC3\x98',#38)", "SHELL_BASED_SURFACE_MODEL('Geh\xC3\xA4use',(#38))"},
         {"(#11,#386)", "(#11)"},
         {"MANIFOLD_SOLID_BREP('bolt-1',#387)", "CARTESIAN_POINT('',(0.,0.,0.))"},
         {"ADVANCED_BREP_SHAPE", "MANIFOLD_SURFACE_SHAPE"}});
    const GmshBrep b = GmshBrep::load(saved("sewn.step", text));
    CHECK(solids(b) == Names{"Geh\xC3\xA4use"});
    CHECK(places_of(b, "\xE5\x85\xA5\xE5\x8F\xA3") == std::multiset<std::string>{"x=0"});
    CHECK(places_of(b, "in-let") == std::multiset<std::string>{"y=0"});
    CHECK(places_of(b, "wall") == std::multiset<std::string>{"y=2", "z=0"});
}

TEST_CASE("triangles of a CAD model carry the names of its faces") {
    const CadTriangulation made = triangulate_solids(fault("names_utf8.step"));
    std::multiset<std::string> names;
    for (const auto& [tag, name] : made.surface.face_names) {
        names.insert(name);
    }
    CHECK(names ==
          std::multiset<std::string>{"\xE5\x85\xA5\xE5\x8F\xA3", "in let", "in-let", "wall", "wall", "1inlet"});
}

#include "cad/step_text.hpp"

#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>

#include <fstream>
#include <iterator>

using namespace pavior;
using detail::StepSolid;

namespace {

std::string fault(const std::string& name) {
    std::ifstream file(std::string(PAVIOR_TEST_DATA).append("/faults/").append(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names(const std::vector<StepSolid>& solids) {
    std::vector<std::string> result;
    for (const StepSolid& solid : solids) {
        result.push_back(solid.name);
    }
    return result;
}

std::vector<std::string> face_names(const StepSolid& solid) {
    std::vector<std::string> result;
    for (const auto& face : solid.faces) {
        result.push_back(face.name);
    }
    return result;
}

using Names = std::vector<std::string>;

/// Products 1 ... with a shape each; \p more are further records.
std::string file_of(const std::string& more) {
    return "ISO-10303-21;\nHEADER;\nFILE_NAME('#1 = PRODUCT(','2026');\nENDSEC;\nDATA;\n" + more +
           "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// A product #n with definition #(n+2), shape #(n+3) and representation #(n+5), which holds \p items.
std::string product(int n, const std::string& name, const std::string& items) {
    const auto id = [n](int k) { return "#" + std::to_string(n + k); };
    return id(0) + "=PRODUCT('id','" + name + "','',(#9));\n" + id(1) + " = PRODUCT_DEFINITION_FORMATION('','', " +
           id(0) + ");" + id(2) + "=PRODUCT_DEFINITION('d','',\n" + id(1) + ",#9);\n" + id(3) +
           "=PRODUCT_DEFINITION_SHAPE('',''," + id(2) + ");" + id(4) + "=SHAPE_DEFINITION_REPRESENTATION(" + id(3) +
           "," + id(5) + ");\n" + id(5) + "=ADVANCED_BREP_SHAPE_REPRESENTATION('',(" + items + "),#9);\n";
}

}  // namespace

TEST_CASE("strings of STEP are read as what they mean") {
    using detail::step_string;
    CHECK(step_string("bolt \"M8\"") == "bolt \"M8\"");
    CHECK(step_string("it''s") == "it's");
    CHECK(step_string("a\\\\b") == "a\\b");
    CHECK(step_string("Geh\\X2\\00E4\\X0\\use") == "Geh\xC3\xA4use");
    CHECK(step_string("\\X2\\516553E3\\X0\\!") == "\xE5\x85\xA5\xE5\x8F\xA3!");
    CHECK(step_string("\\X2\\D83DDE00\\X0\\") == "\xF0\x9F\x98\x80");
    CHECK(step_string("\\X4\\0001F600\\X0\\") == "\xF0\x9F\x98\x80");
    CHECK(step_string("\\X\\D8 \\S\\D \\PA\\x") == "\xC3\x98 \xC3\x84 x");
    CHECK(step_string("Geh\xC3\xA4use") == "Geh\xC3\xA4use");
    CHECK(step_string("Geh\xE4use") == "Geh\xC3\xA4use");  // Latin-1
    CHECK(step_string("two\nlines\t") == "twolines");
    CHECK(step_string("\\Q\\ \\X2\\12\\X0\\").rfind("\\Q\\ ", 0) == 0);  // no directive
    CHECK(step_string("\\").size() == 1);
    CHECK(step_string("").empty());
}

TEST_CASE("names of products, slashes and quotes included") {
    CHECK(names(detail::read_step_solids(fault("pnames_slash.step"))) == Names{"alu/plate", "steel/plate"});
    CHECK(names(detail::read_step_solids(fault("pnames_same.step"))) == Names{"bolt", "bolt"});
    CHECK(names(detail::read_step_solids(fault("pnames_collide.step"))) == Names{"bolt-1", "bolt 1"});
    CHECK(names(detail::read_step_solids(fault("pnames_quote.step"))) == Names{"bolt \"M8\"", "it's"});
    CHECK(names(detail::read_step_solids(fault("pnames_face_clash.step"))) == Names{"face_3", "face_4"});
    CHECK(names(detail::read_step_solids(fault("partial_face.step"))) == Names{"", ""});
}

TEST_CASE("names of solids and faces") {
    const auto solids = detail::read_step_solids(fault("names_utf8.step"));
    CHECK(names(solids) == Names{"Geh\xC3\xA4use \xC3\x98", "bolt-1"});
    CHECK(face_names(solids[0]) == Names{"\xE5\x85\xA5\xE5\x8F\xA3", "in let", "in-let", "wall", "wall", "1inlet"});
    CHECK(solids[0].vertices.size() == 8);
    CHECK(solids[0].faces[0].vertices.size() == 4);
}

TEST_CASE("a product with several solids leaves them their own names") {
    const std::string two = "#50=MANIFOLD_SOLID_BREP('left',#60);#51=BREP_WITH_VOIDS('',#60,(#61));\n";
    CHECK(names(detail::read_step_solids(file_of(product(1, "part", "#50,#51") + two))) == Names{"left", "part"});
    CHECK(names(detail::read_step_solids(file_of(product(1, "part", "#50") + two))) == Names{"part", ""});
    CHECK(names(detail::read_step_solids(file_of(product(1, "NONE", "#50") + two))) == Names{"left", ""});
    CHECK(names(detail::read_step_solids(file_of(product(1, "Open CASCADE 7.6", "#50,#51") + two))) ==
          Names{"left", ""});
    CHECK(names(detail::read_step_solids(file_of(product(1, "", "#50") + two))) == Names{"id", ""});
    CHECK(names(detail::read_step_solids(file_of(two))) == Names{"left", ""});
}

TEST_CASE("parts that are used twice are two solids, by assemblies, related representations and mapped items") {
    const std::string solid = "#50=MANIFOLD_SOLID_BREP('',#60);\n";
    const std::string assembly = product(20, "asm", "#9") +
                                 "#70=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#22,#3,$);\n"
                                 "#71=NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','','',#22,#3,$);\n";
    const auto twice = detail::read_step_solids(file_of(product(1, "bolt", "#50") + assembly + solid));
    CHECK(names(twice) == Names{"bolt", "bolt"});
    CHECK(twice[0].placed);
    const auto related = detail::read_step_solids(file_of(product(1, "bolt", "#9") +
                                                          "#80=SHAPE_REPRESENTATION_RELATIONSHIP('','',#6,#81);\n"
                                                          "#81=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#50),#9);\n" +
                                                          solid));
    CHECK(names(related) == Names{"bolt"});
    CHECK_FALSE(related[0].placed);
    const auto mapped = detail::read_step_solids(file_of(product(1, "nuts", "#82,#83") +
                                                         "#82=MAPPED_ITEM('',#84,#9);#83=MAPPED_ITEM('',#84,#9);\n"
                                                         "#84=REPRESENTATION_MAP(#9,#85);\n"
                                                         "#85=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#50),#9);\n" +
                                                         solid));
    CHECK(names(mapped) == Names{"nuts", "nuts"});
    CHECK(mapped[1].placed);
}

TEST_CASE("comments, semicolons in strings and nonsense do no harm") {
    CHECK(names(detail::read_step_solids(file_of("#50=MANIFOLD_SOLID_BREP('a;b,(c',#60);\n"))) == Names{"a;b,(c"});
    CHECK(names(detail::read_step_solids(file_of("/* #50 = no; */ #50=MANIFOLD_SOLID_BREP('x',#60);\n"))) ==
          Names{"x"});
    for (const char* text : {"", "DATA;", "DATA;#", "DATA;#1=", "DATA;#1=(A();B()", "DATA;#1=PRODUCT('", "DATA;/*",
                             "DATA;#1=MANIFOLD_SOLID_BREP('',#1);", "DATA;#1=NEXT_ASSEMBLY_USAGE_OCCURRENCE();"}) {
        CAPTURE(text);
        CHECK(detail::read_step_solids(text).size() <= 1);
    }
    const std::string circle = product(1, "a", "#9") + "#70=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#3,#3,$);\n";
    CHECK(detail::read_step_solids(file_of(circle)).empty());
    CHECK(detail::read_step_solids(fault("names_utf8.step").substr(0, 20000)).size() <= 2);
}

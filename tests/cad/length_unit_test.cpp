#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/length_unit.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/scratch.hpp"

#include <fstream>
#include <sstream>
#include <string>

using namespace pavior;
using namespace pavior::test;

namespace {

const std::string slot = PAVIOR_TEST_DATA "/faults/slot.step";

std::string with(const std::string& name, const std::string& text) {
    const std::string file = scratch_file(name);
    std::ofstream(file) << text;
    return file;
}

std::string step(const std::string& units) { return "ISO-10303-21;\nDATA;\n" + units + "ENDSEC;\n"; }

/// An example in other units of length.
std::string in_metres() {
    std::ostringstream text;
    text << std::ifstream(slot).rdbuf();
    std::string all = text.str();
    const std::string old = "SI_UNIT(.MILLI.,.METRE.)";
    for (std::size_t at = all.find(old); at != std::string::npos; at = all.find(old)) {
        all.replace(at, old.size(), "SI_UNIT($,.METRE.)");
    }
    return with("metres.step", all);
}

}  // namespace

TEST_CASE("Units have their length in millimetres") {
    CHECK(millimetres("mm") == 1.0);
    CHECK(millimetres("inch") == 25.4);
    CHECK(millimetres("m") == 1000.0);
    CHECK_FALSE(millimetres("furlong").has_value());
}

TEST_CASE("What a STEP file says its lengths are in: SI units, conversions, the first context") {
    CHECK(unit_of_file(with("a.step", step("#1 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n"))) ==
          "mm");
    CHECK(unit_of_file(with("b.stp", step("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"))) == "m");
    const std::string inches =
        "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n/* not ; #9=LENGTH_UNIT */\n"
        "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#1);\n"
        "#3=(CONVERSION_BASED_UNIT('INCH',#2)LENGTH_UNIT()NAMED_UNIT(#8));\n"
        "#4=(GLOBAL_UNIT_ASSIGNED_CONTEXT((#5,#3,#6))REPRESENTATION_CONTEXT('',''));\n";
    CHECK(unit_of_file(with("c.step", step(inches))) == "inch");
    const std::string two =
        "#7=ADVANCED_BREP_SHAPE_REPRESENTATION('a',(#1,#9),#8);\n"
        "#8=(GLOBAL_UNIT_ASSIGNED_CONTEXT((#11))REPRESENTATION_CONTEXT('',''));\n"
        "#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));\n";
    CHECK(unit_of_file(with("g.step", step(inches + two))) == "cm");  // that of the solids
    CHECK(unit_of_file(with("d.step", step("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.PICO.,.METRE.));\n"))) == "unknown");
    CHECK(unit_of_file(with("e.step", step(""))) == "unknown");
    CHECK(unit_of_file(with("f.brep", "DBRep_DrawableShape")) == "unknown");
    CHECK_THROWS_AS(unit_of_file(scratch_file("none.step")), FileError);
}

TEST_CASE("What an IGES file says, by the number in its global section") {
    const auto line = [](const std::string& text, char section) {
        return text + std::string(72 - text.size(), ' ') + section + "      1\n";
    };
    const std::string start = line("S", 'S');
    const auto global = [&](const std::string& flag) {
        return start + line("1H,,1H;,4Hpart,8Ha,b.igs,2Hx;,1Hv,32,38,6,308,15,4Hpart,1.,", 'G') +
               line(flag + ",2HIN,1,1.;", 'G');
    };
    CHECK(unit_of_file(with("a.igs", global("1"))) == "inch");
    CHECK(unit_of_file(with("b.iges", global("2"))) == "mm");
    CHECK(unit_of_file(with("c.iges", global("6"))) == "m");
    CHECK(unit_of_file(with("d.iges", global("99"))) == "unknown");
    CHECK(unit_of_file(with("e.iges", start)) == "unknown");
}

TEST_CASE("Models are in millimetres whatever the file says") {
    const GmshBrep small = GmshBrep::load(slot);
    const std::string file = in_metres();
    CHECK(unit_of_file(file) == "m");
    CHECK(GmshBrep::load(file).diagonal() == Approx(1000 * small.diagonal()));
}

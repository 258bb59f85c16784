#include "support/catch.hpp"

#include <pavior/part/part_options.hpp>

#include <set>

using namespace pavior;

TEST_CASE("Methods have seven different names, those of the command line") {
    std::set<std::string_view> names;
    for (const PartMethod method : {PartMethod::submap, PartMethod::sweep, PartMethod::multi_sweep, PartMethod::mixed,
                                    PartMethod::block, PartMethod::split, PartMethod::decompose}) {
        names.insert(to_string(method));
    }
    CHECK(names ==
          std::set<std::string_view>{"submap", "sweep", "multi-sweep", "mixed", "block", "split", "decompose"});
}

TEST_CASE("Solids are cut unless that is forbidden") {
    CHECK(PartOptions{}.decompose);
    CHECK(PartOptions{}.methods.empty());
}

TEST_CASE("Local lengths of any kind are local lengths") {
    CHECK(LocalLengths{}.empty());
    LocalLengths edge, face, solid, name;
    edge.edge[1] = face.face[1] = solid.solid[1] = name.named["lid"] = 1;
    CHECK_FALSE(edge.empty());
    CHECK_FALSE(face.empty());
    CHECK_FALSE(solid.empty());
    CHECK_FALSE(name.empty());
}

#include "support/catch.hpp"

#include <pavior/part/part_options.hpp>

#include <set>

using namespace pavior;

TEST_CASE("Methods have five different names, those of the command line") {
    std::set<std::string_view> names;
    for (const PartMethod method :
         {PartMethod::submap, PartMethod::sweep, PartMethod::multi_sweep, PartMethod::mixed, PartMethod::block}) {
        names.insert(to_string(method));
    }
    CHECK(names == std::set<std::string_view>{"submap", "sweep", "multi-sweep", "mixed", "block"});
}

TEST_CASE("Local sizes of any kind are local sizes") {
    CHECK_FALSE(PartOptions{}.local_sizes());
    PartOptions edge, face, solid, name;
    edge.edge_size[1] = face.face_size[1] = solid.solid_size[1] = name.named_size["lid"] = 1;
    CHECK(edge.local_sizes());
    CHECK(face.local_sizes());
    CHECK(solid.local_sizes());
    CHECK(name.local_sizes());
}

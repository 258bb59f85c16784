#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/builders.hpp>

#include <stdexcept>

using namespace pavior;

namespace {
// Archetype: counts, keeps nothing, and insists on the order of the calls.
class Counter {
public:
    Counter() = default;
    Counter(const Counter&) = delete;
    Counter& operator=(const Counter&) = delete;
    int add_node(const Vec3&) { return static_cast<int>(nodes_++); }
    bool add_hex(const HexCorners& corners) {
        for (const Index i : corners) {
            if (i >= nodes_) {
                throw std::logic_error("a hexahedron before its nodes");
            }
        }
        ++hexes_;
        return true;
    }
    [[nodiscard]] std::size_t nodes() const { return nodes_; }
    [[nodiscard]] std::size_t hexes() const { return hexes_; }

private:
    std::size_t nodes_ = 0;
    std::size_t hexes_ = 0;
};
struct NodesOnly {
    void add_node(const Vec3&) {}
};
}  // namespace

static_assert(hex_builder<HexMeshBuilder> && hex_builder<Counter>);
static_assert(!hex_builder<NodesOnly> && !hex_builder<HexMesh> && !hex_builder<const HexMeshBuilder>);

TEST_CASE("a mesh is written node by node, then cell by cell") {
    const HexMesh box = shapes::hex_box(2, 3, 4);
    Counter counter;
    write(box, counter);
    CHECK(counter.nodes() == 60);
    CHECK(counter.hexes() == 24);
    Counter archetypes;
    write(archetype::Hexes(box), archetypes);
    CHECK(archetypes.hexes() == 24);
}

TEST_CASE("HexMeshBuilder gives back what was written") {
    const HexMesh box = shapes::hex_box(2, 1, 1);
    HexMeshBuilder builder;
    write(box, builder);
    CHECK(builder.mesh().nodes == box.nodes);
    CHECK(builder.mesh().hexes == box.hexes);
    const HexMesh taken = builder.take();
    CHECK(taken.hexes == box.hexes);
    CHECK(builder.mesh().nodes.empty());
    CHECK(builder.mesh().hexes.empty());
}

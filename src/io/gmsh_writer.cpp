// .msh by hand: Gmsh's own writer does not say when the disk is full. Version 4.1 in binary has the bytes of Gmsh 4.8.
#include "formats.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace pavior::io {

namespace {

/// Cells of one group: one discrete entity and one physical group.
struct Entity {
    int dimension = 3;
    int tag = 1;
    int physical = 0;  ///< 0: none
    std::string name;
    std::vector<std::size_t> members;  ///< positions of the cells
    std::size_t first_element = 1;     ///< tag of the first one
    std::size_t nodes = 0;             ///< how many nodes are written with it: all or none

    [[nodiscard]] int type() const { return dimension == 3 ? 5 : 3; }
};

template <class Cells>
void add_entities(std::vector<Entity>& entities, const Cells& cells, const std::vector<std::int32_t>& groups,
                  const std::vector<MeshGroup>& names, int dimension, std::size_t& next) {
    auto by_group = cells_by_group(cells.size(), groups);
    int tag = 0;
    int free = by_group.empty() ? 1 : std::max(by_group.rbegin()->first, 0) + 1;
    for (auto& [number, members] : by_group) {
        Entity& entity = entities.emplace_back();
        entity.dimension = dimension;
        entity.tag = ++tag;
        entity.physical = number > 0 ? number : free++;
        entity.name = name_of(names, dimension, number);
        entity.members = std::move(members);
        entity.first_element = next;
        next += entity.members.size();
    }
}

/// Surfaces before volumes, as Gmsh has them; elements are counted the other way round.
std::vector<Entity> entities_of(const HexMeshData& data, const std::vector<MeshGroup>& names) {
    std::vector<Entity> entities;
    std::size_t next = 1;
    add_entities(entities, data.mesh.hexes, data.hex_groups, names, 3, next);
    add_entities(entities, data.quads, data.quad_groups, names, 2, next);
    if (entities.empty() && !data.mesh.nodes.empty()) {
        entities.emplace_back();  // for the nodes
    }
    if (!entities.empty()) {
        entities.front().nodes = data.mesh.nodes.size();
    }
    std::stable_sort(entities.begin(), entities.end(),
                     [](const Entity& a, const Entity& b) { return a.dimension < b.dimension; });
    return entities;
}

/// Writes the sections; text and binary differ in value() and separators alone.
class Writer {
public:
    Writer(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& names, bool binary)
        : out_(out), data_(data), entities_(entities_of(data, names)), binary_(binary) {}

    void write_41() {
        write_head("4.1");
        write_entities();
        write_nodes_41();
        write_elements_41();
    }

    void write_22() {
        write_head("2.2");
        write_nodes_22();
        write_elements_22();
    }

private:
    /// One number; in text a space parts it from the one before, if any in this line.
    template <class Value>
    void value(Value number) {
        if (binary_) {
            out_.raw(number);
            return;
        }
        if (!first_) {
            out_.text(" ");
        }
        first_ = false;
        out_.number(number);
    }
    void end_line() {
        if (!binary_) {
            out_.text("\n");
        }
        first_ = true;
    }
    void begin(const char* section) {
        out_.text("$");
        out_.text(section);
        out_.text("\n");
    }
    void end(const char* section) {
        out_.text(binary_ ? "\n$End" : "$End");
        out_.text(section);
        out_.text("\n");
    }
    /// A line that is text in both kinds of file.
    void count_line(std::size_t count) {
        out_.number(count);
        out_.text("\n");
    }

    void write_head(const char* version) {
        begin("MeshFormat");
        out_.text(version);
        out_.text(binary_ ? " 1 8\n" : " 0 8\n");
        if (binary_) {
            out_.raw(1);
        }
        end("MeshFormat");
        const auto named = std::count_if(entities_.begin(), entities_.end(), [](auto& e) { return !e.name.empty(); });
        if (named == 0) {
            return;
        }
        begin("PhysicalNames");
        count_line(static_cast<std::size_t>(named));
        for (const Entity& entity : entities_) {
            if (!entity.name.empty()) {
                out_.text(std::to_string(entity.dimension) + " " + std::to_string(entity.physical) + " \"");
                out_.text(entity.name);
                out_.text("\"\n");
            }
        }
        out_.text("$EndPhysicalNames\n");
    }

    template <class Cells>
    [[nodiscard]] std::array<Vec3, 2> box(const Entity& entity, const Cells& cells) const {
        std::array<Vec3, 2> box{Vec3::Constant(std::numeric_limits<double>::max()),
                                Vec3::Constant(std::numeric_limits<double>::lowest())};
        for (const std::size_t i : entity.members) {
            for (const Index node : cells[i]) {
                box[0] = box[0].cwiseMin(data_.mesh.nodes[node]);
                box[1] = box[1].cwiseMax(data_.mesh.nodes[node]);
            }
        }
        return entity.members.empty() ? std::array<Vec3, 2>{Vec3::Zero(), Vec3::Zero()} : box;
    }

    void write_entities() {
        begin("Entities");
        const auto surfaces =
            std::count_if(entities_.begin(), entities_.end(), [](auto& e) { return e.dimension == 2; });
        value(std::size_t{0});
        value(std::size_t{0});
        value(static_cast<std::size_t>(surfaces));
        value(entities_.size() - static_cast<std::size_t>(surfaces));
        end_line();
        for (const Entity& entity : entities_) {
            value(entity.tag);
            const auto corners = entity.dimension == 3 ? box(entity, data_.mesh.hexes) : box(entity, data_.quads);
            for (const Vec3& corner : corners) {
                write_point(corner);
            }
            value(std::size_t{entity.physical == 0 ? 0U : 1U});
            if (entity.physical != 0) {
                value(entity.physical);
            }
            value(std::size_t{0});  // nothing bounds it
            end_line();
        }
        end("Entities");
    }

    void write_point(const Vec3& x) {
        for (const double coordinate : {x[0], x[1], x[2]}) {
            value(coordinate);
        }
    }

    /// Blocks, items, least and greatest tag.
    void write_counts(std::size_t items) {
        value(entities_.size());
        value(items);
        value(std::size_t{items == 0 ? 0U : 1U});
        value(items);
        end_line();
    }

    void write_nodes_41() {
        begin("Nodes");
        write_counts(data_.mesh.nodes.size());
        for (const Entity& entity : entities_) {
            value(entity.dimension);
            value(entity.tag);
            value(0);  // without parameters
            value(entity.nodes);
            end_line();
            for (std::size_t i = 0; i < entity.nodes; ++i) {
                value(i + 1);
                end_line();
            }
            for (std::size_t i = 0; i < entity.nodes; ++i) {
                write_point(data_.mesh.nodes[i]);
                end_line();
            }
        }
        end("Nodes");
    }

    void write_elements_41() {
        begin("Elements");
        const bool none = data_.mesh.hexes.empty() && data_.quads.empty();
        if (none) {
            value(std::size_t{0});
            value(std::size_t{0});
            value(std::size_t{0});
            value(std::size_t{0});
            end_line();
        } else {
            write_counts(data_.mesh.hexes.size() + data_.quads.size());
        }
        for (const Entity& entity : entities_) {
            if (!none) {
                value(entity.dimension);
                value(entity.tag);
                value(entity.type());
                value(entity.members.size());
                end_line();
                for_each_cell(entity, [&](std::size_t element, std::span<const Index> nodes) {
                    value(element);
                    for (const Index node : nodes) {
                        value(std::size_t{node} + 1);
                    }
                    end_line();
                });
            }
        }
        end("Elements");
    }

    template <class Body>
    void for_each_cell(const Entity& entity, Body&& body) const {
        std::size_t element = entity.first_element;
        for (const std::size_t i : entity.members) {
            if (entity.dimension == 3) {
                body(element++, std::span<const Index>(data_.mesh.hexes[i]));
            } else {
                body(element++, std::span<const Index>(data_.quads[i]));
            }
        }
    }

    void write_nodes_22() {
        begin("Nodes");
        count_line(data_.mesh.nodes.size());
        for (std::size_t i = 0; i < data_.mesh.nodes.size(); ++i) {
            value(static_cast<int>(i + 1));
            write_point(data_.mesh.nodes[i]);
            end_line();
        }
        end("Nodes");
    }

    void write_elements_22() {
        begin("Elements");
        count_line(data_.mesh.hexes.size() + data_.quads.size());
        for (const Entity& entity : entities_) {
            if (binary_ && !entity.members.empty()) {
                value(entity.type());
                value(static_cast<int>(entity.members.size()));
                value(2);  // tags: physical group, entity
            }
            for_each_cell(entity, [&](std::size_t element, std::span<const Index> nodes) {
                value(static_cast<int>(element));
                if (!binary_) {
                    value(entity.type());
                    value(2);
                }
                value(entity.physical);
                value(entity.tag);
                for (const Index node : nodes) {
                    value(static_cast<int>(node + 1));
                }
                end_line();
            });
        }
        end("Elements");
    }

    CheckedOutput& out_;
    const HexMeshData& data_;
    std::vector<Entity> entities_;
    bool binary_;
    bool first_ = true;
};

}  // namespace

void write_gmsh(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups,
                GmshVersion version) {
    Writer writer(out, data, groups, version.binary);
    version.is_41 ? writer.write_41() : writer.write_22();
}

}  // namespace pavior::io

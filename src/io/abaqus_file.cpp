// Abaqus input, by hand: Gmsh 4.8 writes 14 digits and cannot read it back, VTK does not know it.
#include "formats.hpp"

#include <pavior/core/error.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/outward_quads.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unordered_map>

namespace pavior::io {

namespace {

/// Writes the sections; element k has tag k + 1, hexahedra of the lowest group first, then quads.
class Writer {
public:
    Writer(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& names)
        : out_(out), data_(data), names_(names), hex_tags_(data.mesh.hexes.size()) {}

    void write() {
        out_.text("*HEADING\nhexahedral mesh by pavior\n*NODE\n");
        for (std::size_t i = 0; i < data_.mesh.nodes.size(); ++i) {
            out_.number(i + 1);
            for (const double coordinate : {data_.mesh.nodes[i][0], data_.mesh.nodes[i][1], data_.mesh.nodes[i][2]}) {
                out_.text(", ");
                out_.number(coordinate, 17);
            }
            out_.text("\n");
        }
        const auto solids = cells_by_group(data_.mesh.hexes.size(), data_.hex_groups);
        const auto faces = cells_by_group(data_.quads.size(), data_.quad_groups);
        write_cells(data_.mesh.hexes, solids, 3);
        write_cells(data_.quads, faces, 2);
        write_nodes(data_.mesh.hexes, solids, 3);
        write_nodes(data_.quads, faces, 2);
        write_surfaces(faces);
    }

private:
    using Members = std::map<int, std::vector<std::size_t>>;

    void keyword(const char* text, int dimension, int number) {
        out_.text(text);
        out_.text(name_of(names_, dimension, number));
        out_.text("\n");
    }

    template <class Cells>
    void write_cells(const Cells& cells, const Members& groups, int dimension) {
        for (const auto& [number, members] : groups) {
            keyword(dimension == 3 ? "*ELEMENT, TYPE=C3D8, ELSET=" : "*ELEMENT, TYPE=S4, ELSET=", dimension, number);
            for (const std::size_t i : members) {
                if (dimension == 3) {
                    hex_tags_[i] = next_;
                }
                out_.number(next_++);
                for (const Index node : cells[i]) {
                    out_.text(", ");
                    out_.number(std::size_t{node} + 1);
                }
                out_.text("\n");
            }
        }
    }

    /// The nodes of each group, ascending, sixteen a line: no more may stand in one.
    template <class Cells>
    void write_nodes(const Cells& cells, const Members& groups, int dimension) {
        for (const auto& [number, members] : groups) {
            keyword("*NSET, NSET=", dimension, number);
            std::vector<Index> nodes;
            for (const std::size_t i : members) {
                nodes.insert(nodes.end(), cells[i].begin(), cells[i].end());
            }
            std::sort(nodes.begin(), nodes.end());
            nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                out_.number(std::size_t{nodes[k]} + 1);
                out_.text(k + 1 == nodes.size() || k % 16 == 15 ? "\n" : ", ");
            }
        }
    }

    /// The face of the hexahedron under each quad, of the one that it looks out of. Abaqus counts as hex_faces does,
    /// from 1.
    void write_surfaces(const Members& groups) {
        const auto under = faces_under_quads(data_.mesh, data_.quads);
        for (const auto& [number, members] : groups) {
            if (std::all_of(members.begin(), members.end(), [&](auto q) { return under[q][0].hex == no_index; })) {
                continue;
            }
            keyword("*SURFACE, TYPE=ELEMENT, NAME=", 2, number);
            for (const std::size_t q : members) {
                const HexFace& face = looks_out_of(data_.quads[q], under[q][1]) ? under[q][1] : under[q][0];
                if (face.hex != no_index) {
                    out_.number(hex_tags_[face.hex]);
                    out_.text(", S");
                    out_.number(face.face + 1);
                    out_.text("\n");
                }
            }
        }
    }

    [[nodiscard]] bool looks_out_of(const QuadCorners& quad, const HexFace& face) const {
        return face.hex != no_index &&
               from_smallest(quad) == from_smallest(hex_face(data_.mesh.hexes[face.hex], face.face));
    }

    CheckedOutput& out_;
    const HexMeshData& data_;
    const std::vector<MeshGroup>& names_;
    std::vector<std::size_t> hex_tags_;
    std::size_t next_ = 1;
};

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// Value of KEY in "*ELEMENT, TYPE=C3D8, ELSET=bolt"; "" if absent.
std::string keyword_value(const std::string& line, const std::string& key) {
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos) {
            continue;
        }
        std::string name = upper(part.substr(0, equals));
        name.erase(std::remove_if(name.begin(), name.end(), [](unsigned char c) { return std::isspace(c) != 0; }),
                   name.end());
        if (name == key) {
            std::string value = part.substr(equals + 1);
            value.erase(std::remove(value.begin(), value.end(), '\r'), value.end());
            return value;
        }
    }
    return {};
}

/// Reads the keywords *NODE and *ELEMENT (C3D8 families and four-node shells); skips the others.
class Reader {
public:
    explicit Reader(const std::string& file) : file_(file), in_(file) {
        if (!in_) {
            throw FileError(file, "cannot be opened");
        }
    }

    HexMeshData read() {
        for (std::string line; std::getline(in_, line);) {
            ++line_number_;
            if (line.rfind("**", 0) == 0 || line.empty()) {
                continue;
            }
            if (line.front() == '*') {
                start_section(line);
            } else if (section_ == Section::nodes) {
                read_node(line);
            } else if (section_ != Section::other) {
                read_element(line);
            }
        }
        if (data_.mesh.nodes.empty()) {
            throw FileError(file_, "holds no *NODE section");
        }
        return std::move(data_);
    }

private:
    enum class Section { other, nodes, hexes, quads };

    void start_section(const std::string& line) {
        const std::string keyword = upper(line.substr(0, line.find_first_of(", \r")));
        section_ = Section::other;
        if (keyword == "*NODE") {
            section_ = Section::nodes;
        } else if (keyword == "*ELEMENT") {
            start_elements(upper(keyword_value(line, "TYPE")), keyword_value(line, "ELSET"));
        }
    }

    void start_elements(const std::string& type, const std::string& name) {
        if (type == "C3D8" || type == "C3D8R" || type == "C3D8I") {
            section_ = Section::hexes;
        } else if (type == "S4" || type == "S4R" || type == "CPS4" || type == "CPE4") {
            section_ = Section::quads;
        } else if (type.rfind("C3D", 0) == 0) {
            throw FileError(file_, "line " + std::to_string(line_number_) + ": elements of type " + type +
                                       ", not linear hexahedra");
        }
        if (section_ != Section::other) {
            group_ = static_cast<int>(data_.groups.size()) + 1;
            data_.groups.push_back({section_ == Section::hexes ? 3 : 2, group_, name});
        }
    }

    std::vector<double> numbers(std::string line, std::size_t count) const {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream text(line);
        std::vector<double> values;
        for (std::string word; text >> word;) {
            char* end = nullptr;
            values.push_back(std::strtod(word.c_str(), &end));
            if (end == word.c_str() || *end != '\0') {
                break;
            }
        }
        if (values.size() != count || !text.eof()) {
            throw FileError(
                file_, "line " + std::to_string(line_number_) + ": " + std::to_string(count) + " numbers expected");
        }
        return values;
    }

    void read_node(const std::string& line) {
        const std::vector<double> values = numbers(line, 4);
        const std::size_t label = label_of(values[0]);
        const auto place = static_cast<Index>(data_.mesh.nodes.size());
        if (label >= dense_labels) {
            far_position_[label] = place;
        } else {
            if (label >= position_.size()) {
                position_.resize(std::min(std::max(label + 1, 2 * position_.size()), dense_labels), no_index);
            }
            position_[label] = place;
        }
        data_.mesh.nodes.emplace_back(values[1], values[2], values[3]);
    }

    /// Labels in Abaqus have up to nine digits.
    std::size_t label_of(double value) const {
        if (!(value >= 1 && value <= 999999999) || value != std::floor(value)) {
            throw FileError(
                file_, "line " + std::to_string(line_number_) + ": a label is no whole number from 1 to 999999999");
        }
        return static_cast<std::size_t>(value);
    }

    Index node_at(double value) const {
        const std::size_t label = label_of(value);
        const auto far = far_position_.find(label);
        const Index place = far != far_position_.end() ? far->second
                            : label < position_.size() ? position_[label]
                                                       : no_index;
        if (place == no_index) {
            throw FileError(
                file_, "line " + std::to_string(line_number_) + ": node " + std::to_string(label) + " does not exist");
        }
        return place;
    }

    void read_element(const std::string& line) {
        const bool is_hex = section_ == Section::hexes;
        const std::vector<double> values = numbers(line, is_hex ? 9 : 5);
        if (is_hex) {
            HexCorners& hex = data_.mesh.hexes.emplace_back();
            for (std::size_t k = 0; k < 8; ++k) {
                hex[k] = node_at(values[k + 1]);
            }
            data_.hex_groups.push_back(group_);
        } else {
            QuadCorners& quad = data_.quads.emplace_back();
            for (std::size_t k = 0; k < 4; ++k) {
                quad[k] = node_at(values[k + 1]);
            }
            data_.quad_groups.push_back(group_);
        }
    }

    std::string file_;
    std::ifstream in_;
    HexMeshData data_;
    static constexpr std::size_t dense_labels = std::size_t{1} << 24U;
    std::vector<Index> position_;                          ///< of nodes by label, below dense_labels
    std::unordered_map<std::size_t, Index> far_position_;  ///< of the others
    Section section_ = Section::other;
    int group_ = 0;
    std::size_t line_number_ = 0;
};

}  // namespace

void write_abaqus(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups) {
    Writer(out, data, groups).write();
}

HexMeshData read_abaqus(const std::string& file) { return Reader(file).read(); }

}  // namespace pavior::io

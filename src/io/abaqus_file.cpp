// Abaqus input, by hand: Gmsh 4.8 writes 14 digits and cannot read it back, VTK does not know it.
#include "formats.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

namespace pavior::io {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Names in Abaqus hold letters, digits and underscores.
std::string set_name(const HexMeshData& data, int dimension, int number) {
    std::string name = group_name(data, dimension, number);
    if (name.empty()) {
        return (dimension == 3 ? "VOLUME_" : "SURFACE_") + std::to_string(number);
    }
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
            c = '_';
        }
    }
    return name;
}

template <class Cells>
void write_cells(std::FILE* out, const HexMeshData& data, const Cells& cells, const std::vector<std::int32_t>& groups,
                 int dimension, std::size_t& next) {
    for (const auto& [number, members] : cells_by_group(cells.size(), groups)) {
        std::fprintf(out, "*ELEMENT, TYPE=%s, ELSET=%s\n", dimension == 3 ? "C3D8" : "S4",
                     set_name(data, dimension, number).c_str());
        for (const std::size_t i : members) {
            std::fprintf(out, "%zu", next++);
            for (const Index node : cells[i]) {
                std::fprintf(out, ", %zu", std::size_t{node} + 1);
            }
            std::fputc('\n', out);
        }
    }
}

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
        const auto tag = static_cast<std::size_t>(values[0]);
        if (tag >= position_.size()) {
            position_.resize(std::max(tag + 1, 2 * position_.size()), -1);
        }
        position_[tag] = static_cast<std::int64_t>(data_.mesh.nodes.size());
        data_.mesh.nodes.emplace_back(values[1], values[2], values[3]);
    }

    Index node_at(double value) const {
        const auto tag = static_cast<std::size_t>(value);
        if (tag >= position_.size() || position_[tag] < 0) {
            throw FileError(
                file_, "line " + std::to_string(line_number_) + ": node " + std::to_string(tag) + " does not exist");
        }
        return static_cast<Index>(position_[tag]);
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
    std::vector<std::int64_t> position_;
    Section section_ = Section::other;
    int group_ = 0;
    std::size_t line_number_ = 0;
};

}  // namespace

void write_abaqus(const std::string& file, const HexMeshData& data) {
    const File out(std::fopen(file.c_str(), "w"), &std::fclose);
    if (!out) {
        throw FileError(file, "cannot be opened for writing");
    }
    std::fputs("*HEADING\nhexahedral mesh by pavior\n*NODE\n", out.get());
    for (std::size_t i = 0; i < data.mesh.nodes.size(); ++i) {
        const Vec3& x = data.mesh.nodes[i];
        std::fprintf(out.get(), "%zu, %.17g, %.17g, %.17g\n", i + 1, x[0], x[1], x[2]);
    }
    std::size_t next = 1;
    write_cells(out.get(), data, data.mesh.hexes, data.hex_groups, 3, next);
    write_cells(out.get(), data, data.quads, data.quad_groups, 2, next);
    if (std::fflush(out.get()) != 0 || std::ferror(out.get()) != 0) {
        throw FileError(file, "could not be written completely");
    }
}

HexMeshData read_abaqus(const std::string& file) { return Reader(file).read(); }

}  // namespace pavior::io

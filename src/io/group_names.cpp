#include <pavior/io/group_names.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace pavior {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Bytes of the UTF-8 character at the front of \p text; 0 if there is none.
std::size_t character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0x80                       ? 1
                             : byte(0) >= 0xC2 && byte(0) < 0xE0  ? 2
                             : byte(0) >= 0xE0 && byte(0) < 0xF0  ? 3
                             : byte(0) >= 0xF0 && byte(0) <= 0xF4 ? 4
                                                                  : 0;
    if (size == 0 || size > text.size()) {
        return 0;
    }
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xF0 && byte(1) < 0x90);
    const bool surrogate = byte(0) == 0xED && byte(1) >= 0xA0;
    return overlong || surrogate || (byte(0) == 0xF4 && byte(1) >= 0x90) ? 0 : size;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Valid UTF-8 in one line.
std::string printable(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t size = character(text);
        if (size == 0) {
            result += "\xEF\xBF\xBD";
        } else if (size == 1 && (text[0] < ' ' || text[0] == '\x7F')) {
            result += ' ';
        } else if (size == 3 && text[0] == '\xEF' && text[1] == '\xBF' && (text[2] == '\xBE' || text[2] == '\xBF')) {
            result += "\xEF\xBF\xBD";  // no character, which XML forbids
        } else {
            result += text.substr(0, size);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return trimmed(result);
}

/// The longest beginning, in whole characters, whose bytes cost no more than \p limit.
template <class Cost>
std::string cut(const std::string& text, std::size_t limit, Cost&& cost) {
    std::size_t end = 0;
    std::size_t used = 0;
    while (end < text.size()) {
        std::size_t size = character(std::string_view(text).substr(end));
        size = std::max<std::size_t>(size, 1);
        for (std::size_t i = end; i < end + size; ++i) {
            used += cost(text[i]);
        }
        if (used > limit) {
            break;
        }
        end += size;
    }
    return trimmed(text.substr(0, end));
}

std::size_t vtk_cost(char c) { return c > ' ' && c < '\x7F' && c != '"' && c != '%' ? 1 : 3; }
std::size_t one(char /*c*/) { return 1; }

std::string abaqus_label(const MeshGroup& group, const std::string& name) {
    std::string label;
    for (std::size_t i = 0; i < name.size();) {
        const std::size_t size = std::max<std::size_t>(character(std::string_view(name).substr(i)), 1);
        label += is_letter(name[i]) || is_digit(name[i]) ? name[i] : '_';
        i += size;
    }
    if (std::none_of(label.begin(), label.end(), [](char c) { return is_letter(c) || is_digit(c); })) {
        return (group.dimension == 3 ? "VOLUME_" : "SURFACE_") + std::to_string(group.number);
    }
    return is_letter(label[0]) ? label : (group.dimension == 3 ? "V_" : "S_") + label;
}

/// What names a format can hold.
struct Rule {
    MeshFormat format;

    [[nodiscard]] bool abaqus() const { return format == MeshFormat::inp; }

    [[nodiscard]] std::string shortened(const std::string& name, std::size_t spare) const {
        switch (format) {
            case MeshFormat::vtu: return name;
            case MeshFormat::vtk: return cut(name, 240 - spare, vtk_cost);
            case MeshFormat::inp: return cut(name, 80 - spare, one);
            default: return cut(name, 200 - spare, one);
        }
    }

    [[nodiscard]] std::string legal(const MeshGroup& group) const {
        std::string name = printable(group.name);
        if (abaqus()) {
            name = abaqus_label(group, name);
        } else if (format != MeshFormat::vtu && format != MeshFormat::vtk) {
            std::replace(name.begin(), name.end(), '"', '\'');  // ends a name
            std::replace(name.begin(), name.end(), '\\', '/');  // it quotes what follows, says meshio
        }
        return shortened(name, 0);
    }

    /// Two names are one if their keys are.
    [[nodiscard]] std::string key(std::string name) const {
        for (char& c : name) {
            c = abaqus() && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        }
        return name;
    }
};

auto order(const MeshGroup& group) { return std::make_tuple(-group.dimension, group.number); }

/// The groups in their order; with numbers that only cells have if \p all.
std::vector<MeshGroup> listed(const HexMeshData& data, bool all) {
    std::vector<MeshGroup> groups = data.groups;
    if (all) {
        for (const std::int32_t number : std::set<std::int32_t>(data.hex_groups.begin(), data.hex_groups.end())) {
            groups.push_back({3, number, {}});
        }
        for (const std::int32_t number : std::set<std::int32_t>(data.quad_groups.begin(), data.quad_groups.end())) {
            groups.push_back({2, number, {}});
        }
        if (data.hex_groups.empty() && !data.mesh.hexes.empty()) {
            groups.push_back({3, 0, {}});
        }
        if (data.quad_groups.empty() && !data.quads.empty()) {
            groups.push_back({2, 0, {}});
        }
    }
    std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return order(a) < order(b); });
    groups.erase(
        std::unique(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return order(a) == order(b); }),
        groups.end());
    return groups;
}

/// Keeps the first of each name and puts numbers behind the others.
class Names {
public:
    explicit Names(Rule rule) : rule_(rule) {
        if (rule.format == MeshFormat::vtk) {
            taken_.insert("METADATA");  // a keyword there
        }
    }

    bool take(const std::string& name) { return taken_.insert(rule_.key(name)).second; }

    std::string numbered(const std::string& name) {
        for (std::size_t& n = last_.try_emplace(rule_.key(name), 1).first->second;;) {
            const std::string suffix = "_" + std::to_string(++n);
            const std::string other = rule_.shortened(name, suffix.size()) + suffix;
            if (take(other)) {
                return other;
            }
        }
    }

private:
    Rule rule_;
    std::set<std::string> taken_;
    std::map<std::string, std::size_t> last_;
};

}  // namespace

std::vector<MeshGroup> names_in_file(const HexMeshData& data, MeshFormat format) {
    const Rule rule{format};
    const std::vector<MeshGroup> groups = listed(data, rule.abaqus());
    std::vector<MeshGroup> result = groups;
    Names names(rule);
    std::vector<char> settled(groups.size(), 0);
    for (const bool changed : {false, true}) {
        for (std::size_t i = 0; i < groups.size(); ++i) {
            if (!changed) {
                result[i].name = rule.legal(groups[i]);
            }
            const bool mine = changed == (result[i].name != groups[i].name);
            settled[i] = settled[i] != 0 || result[i].name.empty() || (mine && names.take(result[i].name)) ? 1 : 0;
        }
    }
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (settled[i] == 0) {
            result[i].name = names.numbered(result[i].name);
        }
    }
    return result;
}

}  // namespace pavior

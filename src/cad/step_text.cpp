#include "step_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace pavior::detail {

namespace {

using Id = std::int64_t;

void append_utf8(std::uint32_t code, std::string& text) {
    const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    if (code < 0x20 || code == 0x7F) {
        return;
    }
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xC0U | code >> 6U);
        put(0x80U | (code & 0x3FU));
    } else if (code < 0x10000) {
        put(0xE0U | code >> 12U);
        put(0x80U | (code >> 6U & 0x3FU));
        put(0x80U | (code & 0x3FU));
    } else if (code < 0x110000) {
        put(0xF0U | code >> 18U);
        put(0x80U | (code >> 12U & 0x3FU));
        put(0x80U | (code >> 6U & 0x3FU));
        put(0x80U | (code & 0x3FU));
    }
}

/// A number of \p digits hexadecimal digits at the front; false if there are none.
bool take_hex(std::string_view& text, std::size_t digits, std::uint32_t& code) {
    const char* const end = text.data() + std::min(digits, text.size());
    if (text.size() < digits || std::from_chars(text.data(), end, code, 16).ptr != end) {
        return false;
    }
    text.remove_prefix(digits);
    return true;
}

/// \X2\00E4D83D\X0\ after its first four characters: UTF-16 or UTF-32.
void take_wide(std::string_view& text, std::size_t digits, std::string& result) {
    std::uint32_t code = 0;
    std::uint32_t high = 0;
    while (take_hex(text, digits, code)) {
        if (code >= 0xD800 && code < 0xDC00) {
            high = code;
        } else if (code >= 0xDC00 && code < 0xE000) {
            append_utf8(high == 0 ? 0xFFFD : 0x10000 + ((high - 0xD800) << 10U) + (code - 0xDC00), result);
            high = 0;
        } else {
            append_utf8(code, result);
        }
    }
    if (text.rfind("\\X0\\", 0) == 0) {
        text.remove_prefix(4);
    }
}

/// Bytes of a UTF-8 character at the front of \p text, 0 if they are none.
std::size_t utf8_size(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t size = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
    for (std::size_t i = 1; i < size; ++i) {
        if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80) {
            return 0;
        }
    }
    return size;
}

/// Takes one of the directives that begin with a backslash; false if it is none.
bool take_directive(std::string_view& text, std::string& result) {
    const auto begins = [&](std::string_view with) { return text.rfind(with, 0) == 0; };
    std::uint32_t code = 0;
    if (begins("\\\\")) {
        result += '\\';
        text.remove_prefix(2);
    } else if (begins("\\S\\") && text.size() > 3) {
        append_utf8(static_cast<unsigned char>(text[3]) | 0x80U, result);
        text.remove_prefix(4);
    } else if (begins("\\P") && text.size() > 3 && text[3] == '\\') {  // another part of ISO 8859: taken for the first
        text.remove_prefix(4);
    } else if (begins("\\X2\\") || begins("\\X4\\")) {
        const std::size_t digits = text[2] == '2' ? 4 : 8;
        text.remove_prefix(4);
        take_wide(text, digits, result);
    } else if (begins("\\X\\") && text.size() > 4) {
        text.remove_prefix(3);
        if (take_hex(text, 2, code)) {
            append_utf8(code, result);
        }
    } else {
        return false;
    }
    return true;
}

}  // namespace

std::string step_string(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        if (text[0] == '\\' && take_directive(text, result)) {
            continue;
        }
        if (text[0] == '\'' && text.size() > 1 && text[1] == '\'') {
            text.remove_prefix(1);
        }
        const std::size_t size = utf8_size(text);
        if (size > 1) {
            result += text.substr(0, size);
        } else {
            append_utf8(static_cast<unsigned char>(text[0]), result);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return result;
}

namespace {

/// One instance of the data section, or one record of a complex one.
struct Record {
    std::string_view keyword;
    std::vector<std::string_view> arguments;
};

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

std::string_view stripped(std::string_view text) {
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

/// The first of \p marks at depth 0, outside of strings and comments; text.size() if there is none.
std::size_t find_mark(std::string_view text, std::size_t from, std::string_view marks) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\'') {
            i = text.find('\'', i + 1);
            if (i == std::string_view::npos) {
                break;
            }
        } else if (c == '/' && i + 1 < text.size() && text[i + 1] == '*') {
            i = text.find("*/", i + 2);
            if (i == std::string_view::npos) {
                break;
            }
            ++i;
        } else if (depth == 0 && marks.find(c) != std::string_view::npos) {
            return i;
        } else if (c == '(') {
            ++depth;
        } else if (c == ')') {
            --depth;
        }
    }
    return text.size();
}

/// "KEYWORD(a,b)" taken apart; no keyword if it is no such thing.
Record record_of(std::string_view text) {
    Record record;
    text = stripped(text);
    const std::size_t open = text.find('(');
    if (open == std::string_view::npos || open == 0 || text.back() != ')') {
        return record;
    }
    record.keyword = stripped(text.substr(0, open));
    const std::string_view inside = text.substr(open + 1, text.size() - open - 2);
    for (std::size_t at = 0; at <= inside.size();) {
        const std::size_t end = find_mark(inside, at, ",");
        record.arguments.push_back(stripped(inside.substr(at, end - at)));
        at = end + 1;
    }
    return record;
}

Id reference(std::string_view text) {
    Id id = 0;
    if (text.size() > 1 && text[0] == '#') {
        std::from_chars(text.data() + 1, text.data() + text.size(), id);
    }
    return id;
}

/// "(#1,#2)"
std::vector<Id> references(std::string_view text) {
    std::vector<Id> ids;
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1)) {
        ids.push_back(reference(text.substr(at)));
    }
    return ids;
}

/// All instances of the data sections by id; records are read when they are asked for.
class Instances {
public:
    explicit Instances(std::string_view text) {
        for (std::size_t at = data_begin(text); at < text.size();) {
            const std::size_t end = find_mark(text, at, ";");
            const std::string_view line = stripped(without_comment(text.substr(at, end - at)));
            const std::size_t equals = line.find('=');
            if (const Id id = reference(line); id > 0 && equals != std::string_view::npos) {
                text_.emplace(id, stripped(line.substr(equals + 1)));
                ids_.push_back(id);
            }
            at = end + 1;
        }
    }

    [[nodiscard]] const std::vector<Id>& ids() const { return ids_; }

    [[nodiscard]] std::string_view keyword(Id id) const {
        const auto found = text_.find(id);
        const std::string_view text = found == text_.end() ? std::string_view() : found->second;
        return stripped(text.substr(0, text.find('(')));
    }

    [[nodiscard]] Record operator[](Id id) const {
        const auto found = text_.find(id);
        return found == text_.end() ? Record() : record_of(found->second);
    }

    /// Argument \p i of an instance, empty if there are not so many.
    [[nodiscard]] std::string_view argument(Id id, std::size_t i) const {
        const Record record = (*this)[id];
        return i < record.arguments.size() ? record.arguments[i] : std::string_view();
    }

private:
    static std::size_t data_begin(std::string_view text) {
        const std::size_t begin = text.find("DATA;");
        return begin == std::string_view::npos ? text.size() : begin + 5;
    }

    static std::string_view without_comment(std::string_view text) {
        text = stripped(text);
        while (text.rfind("/*", 0) == 0) {
            const std::size_t end = text.find("*/");
            text = end == std::string_view::npos ? std::string_view() : stripped(text.substr(end + 2));
        }
        return text;
    }

    std::unordered_map<Id, std::string_view> text_;
    std::vector<Id> ids_;  ///< in the order of the file
};

std::string_view unquoted(std::string_view text) {
    return text.size() >= 2 && text.front() == '\'' && text.back() == '\'' ? text.substr(1, text.size() - 2)
                                                                           : std::string_view();
}

/// A name that somebody gave.
std::string given_name(std::string_view argument) {
    const std::string name = step_string(unquoted(argument));
    const std::size_t first = name.find_first_not_of(' ');
    const bool none = first == std::string::npos || name == "NONE" || name.rfind("Open CASCADE ", 0) == 0;
    return none ? std::string() : name.substr(first, name.find_last_not_of(' ') - first + 1);
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Walks through products, representations and shells.
class Reader {
public:
    explicit Reader(std::string_view text) : instances_(text) {
        for (const Id id : instances_.ids()) {
            sort_in(id);
        }
    }

    std::vector<StepSolid> read() {
        std::set<Id> parts;  // products that an assembly holds
        for (const auto& [assembly, children] : children_) {
            parts.insert(children.begin(), children.end());
        }
        for (const Id definition : definitions_) {
            if (parts.count(definition) == 0) {
                add_product(definition, false, 0);
            }
        }
        for (const Id solid : solids()) {
            if (used_.count(solid) == 0) {
                add_solid(solid, 0, false, false);
            }
        }
        return std::move(result_);
    }

private:
    void sort_in(Id id) {
        const std::string_view keyword = instances_.keyword(id);
        if (keyword == "SHAPE_DEFINITION_REPRESENTATION") {
            const Id shape = reference(instances_.argument(id, 0));
            const Id definition = reference(instances_.argument(shape, 2));
            const std::string_view kind = instances_.keyword(definition);
            if (kind.rfind("PRODUCT_DEFINITION", 0) == 0 && !contains(kind, "RELATIONSHIP")) {
                if (representations_[definition].empty()) {
                    definitions_.push_back(definition);
                }
                representations_[definition].push_back(reference(instances_.argument(id, 1)));
            }
        } else if (keyword == "NEXT_ASSEMBLY_USAGE_OCCURRENCE") {
            children_[reference(instances_.argument(id, 3))].push_back(reference(instances_.argument(id, 4)));
        } else if (keyword == "SHAPE_REPRESENTATION_RELATIONSHIP") {
            const Id one = reference(instances_.argument(id, 2));
            const Id other = reference(instances_.argument(id, 3));
            related_[one].push_back(other);
            related_[other].push_back(one);
        } else if (is_volume(keyword)) {
            volumes_.push_back(id);
        } else if (is_surface(keyword)) {
            surfaces_.push_back(id);
        }
    }

    static bool is_volume(std::string_view keyword) {
        return keyword == "MANIFOLD_SOLID_BREP" || keyword == "BREP_WITH_VOIDS" || keyword == "FACETED_BREP";
    }
    static bool is_surface(std::string_view keyword) { return keyword == "SHELL_BASED_SURFACE_MODEL"; }

    /// What becomes a solid.
    [[nodiscard]] const std::vector<Id>& solids() const { return volumes_.empty() ? surfaces_ : volumes_; }
    [[nodiscard]] bool is_solid(std::string_view keyword) const {
        return volumes_.empty() ? is_surface(keyword) : is_volume(keyword);
    }

    void add_product(Id definition, bool placed, int depth) {
        if (depth > 100) {
            return;  // a circle
        }
        const auto children = children_.find(definition);
        if (children != children_.end()) {
            for (const Id child : children->second) {
                add_product(child, true, depth + 1);
            }
        }
        std::vector<std::pair<Id, bool>> solids;
        std::vector<Id> path;
        if (const auto own = representations_.find(definition); own != representations_.end()) {
            for (const Id representation : own->second) {
                collect(representation, placed, path, solids);
            }
        }
        for (const auto& [solid, moved] : solids) {
            add_solid(solid, definition, moved, solids.size() == 1);
        }
    }

    /// The solids of a representation, of those it is related to, and of those it holds placed; \p path leads here.
    void collect(Id representation, bool placed, std::vector<Id>& path,
                 std::vector<std::pair<Id, bool>>& solids) const {
        if (std::find(path.begin(), path.end(), representation) != path.end()) {
            return;
        }
        path.push_back(representation);
        for (const Id item : references(instances_.argument(representation, 1))) {
            const std::string_view keyword = instances_.keyword(item);
            if (is_solid(keyword) && std::count(solids.begin(), solids.end(), std::pair(item, false)) == 0) {
                solids.emplace_back(item, placed);
            } else if (keyword == "MAPPED_ITEM") {
                const Id map = reference(instances_.argument(item, 1));
                collect(reference(instances_.argument(map, 1)), true, path, solids);
            }
        }
        if (const auto related = related_.find(representation); related != related_.end()) {
            for (const Id other : related->second) {
                collect(other, placed, path, solids);
            }
        }
        path.pop_back();
    }

    /// PRODUCT's name, else its id.
    [[nodiscard]] std::string_view product_of(Id definition) const {
        const Id formation = reference(instances_.argument(definition, 2));
        const Id product = reference(instances_.argument(formation, 2));
        const std::string_view name = instances_.argument(product, 1);
        return unquoted(stripped(unquoted(name)).empty() ? instances_.argument(product, 0) : name);
    }

    void add_solid(Id id, Id definition, bool placed, bool alone) {
        used_.insert(id);
        StepSolid& solid = result_.emplace_back();
        solid.placed = placed;
        solid.surface = volumes_.empty();
        const std::string_view product = definition == 0 ? std::string_view() : product_of(definition);
        solid.product = product;
        const std::string quoted = "'" + solid.product + "'";
        const std::string of_product = given_name(quoted);
        const std::string own = given_name(instances_.argument(id, 0));
        solid.name = (alone && !of_product.empty()) || own.empty() ? of_product : own;
        std::map<Id, Vec3> all;
        for (const Id shell : shells(id)) {
            const bool oriented = instances_.keyword(shell) == "ORIENTED_CLOSED_SHELL";
            const Id closed = oriented ? reference(instances_.argument(shell, 2)) : shell;
            for (const Id face : references(instances_.argument(closed, 1))) {
                add_face(face, solid, all);
            }
        }
        for (const auto& [vertex, point] : all) {
            solid.vertices.push_back(point);
        }
    }

    [[nodiscard]] std::vector<Id> shells(Id solid) const {
        std::vector<Id> ids = references(instances_.argument(solid, 1));
        const std::vector<Id> voids = references(instances_.argument(solid, 2));
        ids.insert(ids.end(), voids.begin(), voids.end());
        return ids;
    }

    void add_face(Id id, StepSolid& solid, std::map<Id, Vec3>& all) const {
        const Id face = instances_.keyword(id) == "ORIENTED_FACE" ? reference(instances_.argument(id, 2)) : id;
        StepFace& result = solid.faces.emplace_back();
        result.name = given_name(instances_.argument(face, 0));
        std::map<Id, Vec3> own;
        for (const Id bound : references(instances_.argument(face, 1))) {
            for (const Id oriented : references(instances_.argument(reference(instances_.argument(bound, 1)), 1))) {
                const Id edge = reference(instances_.argument(oriented, 3));
                for (const std::size_t end : {std::size_t{1}, std::size_t{2}}) {
                    add_vertex(reference(instances_.argument(edge, end)), own);
                }
            }
        }
        for (const auto& [vertex, point] : own) {
            result.vertices.push_back(point);
        }
        all.insert(own.begin(), own.end());
    }

    void add_vertex(Id vertex, std::map<Id, Vec3>& points) const {
        const std::string_view text = instances_.argument(reference(instances_.argument(vertex, 1)), 1);
        if (text.size() < 2 || points.count(vertex) != 0) {
            return;
        }
        std::string numbers(text.substr(1));
        std::replace(numbers.begin(), numbers.end(), ',', ' ');
        Vec3 point = Vec3::Zero();
        const char* at = numbers.c_str();
        for (Eigen::Index k = 0; k < 3; ++k) {
            char* end = nullptr;
            point[k] = std::strtod(at, &end);
            at = end;
        }
        points.emplace(vertex, point);
    }

    Instances instances_;
    std::vector<Id> definitions_;                    ///< products with a shape, in the order of the file
    std::map<Id, std::vector<Id>> representations_;  ///< of a product
    std::map<Id, std::vector<Id>> children_;         ///< of an assembly
    std::map<Id, std::vector<Id>> related_;          ///< representations that are one
    std::vector<Id> volumes_;
    std::vector<Id> surfaces_;
    std::set<Id> used_;
    std::vector<StepSolid> result_;
};

}  // namespace

std::vector<StepSolid> read_step_solids(std::string_view text) { return Reader(text).read(); }

}  // namespace pavior::detail

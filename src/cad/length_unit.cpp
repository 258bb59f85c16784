#include <pavior/cad/length_unit.hpp>

#include "gmsh_import.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace pavior {

namespace {

constexpr const char* unknown = "unknown";

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw FileError(file.string(), "cannot be opened");
    }
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

constexpr const char* solids = "BREP_SHAPE_REPRESENTATION(";

/// The statements of an exchange structure: without comments and blanks, in capitals; texts in quotes keep their blanks.
std::vector<std::string> statements(const std::string& text) {
    std::vector<std::string> list(1);
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (!quoted && c == '/' && i + 1 < text.size() && text[i + 1] == '*') {
            const std::size_t end = text.find("*/", i + 2);
            i = end == std::string::npos ? text.size() : end + 1;
            continue;
        }
        quoted = quoted != (c == '\'');
        if (!quoted && c == ';') {
            if (list.back().find("UNIT") == std::string::npos && list.back().find(solids) == std::string::npos) {
                list.back().clear();  // nothing that is looked for
            } else {
                list.emplace_back();
            }
        } else if (quoted || std::isspace(c) == 0) {
            list.back().push_back(static_cast<char>(std::toupper(c)));
        }
    }
    return list;
}

/// The number after '#' at \p at, or 0.
long reference(const std::string& text, std::size_t at) {
    long number = 0;
    if (at < text.size() && text[at] == '#') {
        std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
    }
    return number;
}

std::string unit_of_statement(const std::string& statement) {
    if (const std::size_t own = statement.find("CONVERSION_BASED_UNIT('"); own != std::string::npos) {
        const std::size_t from = own + std::string_view("CONVERSION_BASED_UNIT('").size();
        const std::string name = statement.substr(from, statement.find('\'', from) - from);
        static const std::map<std::string, const char*> names{
            {"INCH", "inch"}, {"IN", "inch"}, {"INCHES", "inch"},   {"FOOT", "foot"},     {"FEET", "foot"},
            {"FT", "foot"},   {"MIL", "mil"}, {"MILE", "mile"},     {"YARD", "yard"},     {"MILLIMETRE", "mm"},
            {"METRE", "m"},   {"METER", "m"}, {"CENTIMETRE", "cm"}, {"MILLIMETER", "mm"}, {"CENTIMETER", "cm"}};
        const auto known = names.find(name);
        return known == names.end() ? unknown : known->second;
    }
    static const std::array<std::pair<const char*, const char*>, 6> prefixes{{{"SI_UNIT(.MILLI.,.METRE.)", "mm"},
                                                                              {"SI_UNIT($,.METRE.)", "m"},
                                                                              {"SI_UNIT(.CENTI.,.METRE.)", "cm"},
                                                                              {"SI_UNIT(.DECI.,.METRE.)", "dm"},
                                                                              {"SI_UNIT(.MICRO.,.METRE.)", "um"},
                                                                              {"SI_UNIT(.KILO.,.METRE.)", "km"}}};
    for (const auto& [text, unit] : prefixes) {
        if (statement.find(text) != std::string::npos) {
            return unit;
        }
    }
    return unknown;
}

/// By number of each context of units the unit of length in it, if any.
std::map<long, std::string> contexts_of(const std::vector<std::string>& all,
                                        const std::map<long, std::string>& lengths) {
    std::map<long, std::string> contexts;
    for (const std::string& statement : all) {
        const std::size_t context = statement.find("GLOBAL_UNIT_ASSIGNED_CONTEXT((");
        if (context == std::string::npos) {
            continue;
        }
        const std::size_t end = statement.find(')', context);
        for (std::size_t at = statement.find('#', context); at < end; at = statement.find('#', at + 1)) {
            if (const auto found = lengths.find(reference(statement, at)); found != lengths.end()) {
                contexts.emplace(reference(statement, 0), found->second);
            }
        }
    }
    return contexts;
}

/// Of the context of the first solids, else of the first context, else of the first statement that is one.
std::string step_unit(const std::string& text) {
    const std::vector<std::string> all = statements(text);
    std::map<long, std::string> lengths;
    std::string first = unknown;
    for (const std::string& statement : all) {
        if (statement.find("LENGTH_UNIT()") != std::string::npos) {
            const std::string unit = unit_of_statement(statement);
            first = lengths.empty() ? unit : first;
            lengths.emplace(reference(statement, 0), unit);
        }
    }
    const std::map<long, std::string> contexts = contexts_of(all, lengths);
    for (const std::string& statement : all) {
        const std::size_t last = statement.find(solids) == std::string::npos ? std::string::npos : statement.rfind('#');
        const auto own = contexts.find(last == std::string::npos ? 0 : reference(statement, last));
        if (own != contexts.end()) {
            return own->second;
        }
    }
    return contexts.empty() ? first : contexts.begin()->second;
}

/// The parameters of the global section, the 14th of which numbers the unit.
std::string iges_unit(const std::string& text) {
    std::string global;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        if (end - at >= 73 && text[at + 72] == 'G') {
            global.append(text, at, 72);
        }
        at = end + 1;
    }
    std::vector<std::string> parameters(1);
    char separator = ',';
    for (std::size_t i = 0; i < global.size() && parameters.size() <= 14; ++i) {
        const char c = global[i];
        std::string& own = parameters.back();
        std::size_t length = 0;
        const auto [rest, failure] = std::from_chars(own.data(), own.data() + own.size(), length);
        if (c == 'H' && failure == std::errc() && rest == own.data() + own.size()) {
            own = global.substr(std::min(i + 1, global.size()), length);
            i += length;
            if (parameters.size() == 1 && own.size() == 1) {
                separator = own[0];
            }
            if (i + 1 < global.size()) {
                ++i;
                parameters.emplace_back();
            }
        } else if (c == separator) {
            parameters.emplace_back();
        } else if (c != ' ') {
            own.push_back(c);
        }
    }
    static const std::map<std::string, const char*> units{{"1", "inch"}, {"2", "mm"}, {"4", "foot"},
                                                          {"5", "mile"}, {"6", "m"},  {"7", "km"},
                                                          {"8", "mil"},  {"9", "um"}, {"10", "cm"}};
    const auto known = parameters.size() < 14 ? units.end() : units.find(parameters[13]);
    return known == units.end() ? unknown : known->second;
}

}  // namespace

std::optional<double> millimetres(std::string_view unit) {
    static const std::map<std::string_view, double> factors{
        {"um", 1e-3},  {"mm", 1.0},     {"cm", 10.0},   {"dm", 100.0},       {"m", 1e3},
        {"km", 1e6},   {"mil", 0.0254}, {"inch", 25.4}, {"in", 25.4},        {"foot", 304.8},
        {"ft", 304.8}, {"yard", 914.4}, {"yd", 914.4},  {"mile", 1609344.0}, {"mi", 1609344.0}};
    const auto found = factors.find(unit);
    return found == factors.end() ? std::nullopt : std::optional(found->second);
}

std::string unit_of_file(const std::filesystem::path& file) {
    const std::string format = detail::cad_format(file);
    if (format == "step") {
        return step_unit(text_of(file));
    }
    return format == "iges" ? iges_unit(text_of(file)) : unknown;
}

}  // namespace pavior

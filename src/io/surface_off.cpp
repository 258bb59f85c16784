#include "surface_formats.hpp"

#include <string>

namespace pavior::io {

namespace {

/// The counts may stand in the line of the keyword or in the next one.
std::array<std::int64_t, 2> read_counts(LineReader& lines) {
    if (!lines.next_line()) {
        lines.fail("empty file");
    }
    std::string_view word = lines.word();
    if (!to_integer(word)) {
        const bool known = word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF" || word == "STOFF" ||
                           word == "STCOFF" || word == "STNOFF" || word == "STCNOFF";
        if (!known) {
            lines.fail("expected 'OFF', not '" + std::string(word) + "'");
        }
        word = lines.word();
        if (word == "BINARY") {
            lines.fail("binary OFF files cannot be read");
        }
        if (word.empty() && lines.next_line()) {
            word = lines.word();
        }
    }
    const std::optional<std::int64_t> nodes = to_integer(word);
    if (!nodes) {
        lines.fail("the number of vertices is missing");
    }
    return {*nodes, lines.integer("the number of faces")};
}

}  // namespace

PolygonSoup read_off(const std::string& file, std::string_view text) {
    LineReader lines(file, text, '#');
    const auto [node_count, face_count] = read_counts(lines);
    const auto limit = static_cast<std::int64_t>(text.size());
    if (node_count < 0 || face_count < 0 || node_count > limit || face_count > limit) {
        lines.fail("impossible numbers of vertices and faces");
    }
    PolygonSoup soup;
    for (std::int64_t i = 0; i < node_count; ++i) {
        if (!lines.next_line()) {
            lines.fail("the file ends before vertex " + std::to_string(i));
        }
        const double x = lines.number("x");
        const double y = lines.number("y");
        const double z = lines.number("z");
        soup.nodes.emplace_back(x, y, z);
    }
    for (std::int64_t f = 0; f < face_count; ++f) {
        if (!lines.next_line()) {
            lines.fail("the file ends before face " + std::to_string(f));
        }
        const std::int64_t corners = lines.integer("the number of corners");
        if (corners < 3 || corners > limit) {
            lines.fail("face " + std::to_string(f) + " with " + std::to_string(corners) + " corners");
        }
        for (std::int64_t k = 0; k < corners; ++k) {
            const std::int64_t id = lines.integer("a corner");
            if (id < 0 || id >= node_count) {
                lines.fail("face " + std::to_string(f) + " names vertex " + std::to_string(id) +
                           ", which does not exist");
            }
            soup.corners.push_back(static_cast<Index>(id));
        }
        soup.end_face(0);
    }
    return soup;
}

}  // namespace pavior::io

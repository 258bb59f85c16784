#include "surface_formats.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace pavior::io {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t record_size = 50;

std::uint32_t little_endian(const char* at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) {
        value = value << 8U | static_cast<unsigned char>(at[i]);
    }
    return value;
}

PolygonSoup read_binary(const std::string& file, std::string_view text) {
    const std::size_t count = little_endian(text.data() + 80);
    if (text.size() < header_size + count * record_size) {
        throw FileError(file, "holds " + std::to_string((text.size() - header_size) / record_size) + " of the " +
                                  std::to_string(count) + " triangles that its header promises");
    }
    PolygonSoup soup;
    for (std::size_t t = 0; t < count; ++t) {
        const char* record = text.data() + header_size + t * record_size + 12;  // after the normal
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Vec3 x;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto value = std::bit_cast<float>(little_endian(record + 12 * corner + 4 * axis));
                if (!std::isfinite(value)) {
                    throw FileError(file, "triangle " + std::to_string(t) + " has a coordinate that is not finite",
                                    {static_cast<std::int64_t>(t)});
                }
                x[static_cast<Eigen::Index>(axis)] = static_cast<double>(value);
            }
            soup.corners.push_back(static_cast<Index>(soup.nodes.size()));
            soup.nodes.push_back(x);
        }
        soup.end_face(0);
    }
    return soup;
}

/// Lines of ASCII STL; keywords in any case.
class AsciiReader {
public:
    AsciiReader(const std::string& file, std::string_view text) : lines_(file, text, '\0') {}

    PolygonSoup read() {
        std::int32_t solid = 0;
        bool open = false;
        while (lines_.next_line()) {
            const std::string word = keyword();
            if (word == "solid") {
                ++solid;
                open = true;
                soup_.names.emplace_back(lines_.rest());
            } else if (word == "facet") {
                read_facet(solid);
            } else if (word == "endsolid") {
                open = false;
            } else {
                lines_.fail("expected 'facet', 'solid' or 'endsolid', not '" + word + "'");
            }
        }
        if (open) {
            lines_.fail("the file ends before 'endsolid'");
        }
        if (solid < 2) {
            soup_.tags.assign(soup_.tags.size(), 0);
            soup_.names.clear();
        }
        return std::move(soup_);
    }

private:
    std::string keyword() {
        std::string word(lines_.word());
        for (char& c : word) {
            c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        }
        return word;
    }

    void expect(const char* first) {
        if (!lines_.next_line()) {
            lines_.fail("the file ends where '" + std::string(first) + "' should stand");
        }
        if (const std::string word = keyword(); word != first) {
            lines_.fail("expected '" + std::string(first) + "', not '" + word + "'");
        }
    }

    void read_facet(std::int32_t solid) {
        expect("outer");  // loop; the normal follows from the corners
        for (int corner = 0; corner < 3; ++corner) {
            expect("vertex");
            const double x = lines_.number("x");
            const double y = lines_.number("y");
            const double z = lines_.number("z");
            soup_.corners.push_back(static_cast<Index>(soup_.nodes.size()));
            soup_.nodes.emplace_back(x, y, z);
        }
        expect("endloop");
        expect("endfacet");
        soup_.end_face(solid);
    }

    LineReader lines_;
    PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_stl(const std::string& file, std::string_view text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    // Binary files may begin with "solid", too: their size gives them away, or a byte that no text has.
    const bool fits = text.size() >= header_size &&
                      text.size() == header_size + record_size * std::size_t{little_endian(text.data() + 80)};
    const std::size_t mark = text.substr(0, byte_order_mark.size()) == byte_order_mark ? byte_order_mark.size() : 0;
    const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n", mark), text.size());
    std::string word(text.substr(begin, 5));
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    const bool is_text = word == "solid" && text.find('\0') == std::string_view::npos;
    if (fits || (!is_text && text.size() >= header_size)) {
        return read_binary(file, text);
    }
    if (!is_text) {
        throw FileError(file, "is no STL file: neither does it begin with 'solid' nor is it long enough for a header");
    }
    return AsciiReader(file, text.substr(mark)).read();
}

}  // namespace pavior::io

#include "surface_formats.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace pavior::io {

namespace {

enum class Kind : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

std::optional<Kind> kind_of(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Kind>, 16> known{{{"char", Kind::i8},
                                                                       {"uchar", Kind::u8},
                                                                       {"short", Kind::i16},
                                                                       {"ushort", Kind::u16},
                                                                       {"int", Kind::i32},
                                                                       {"uint", Kind::u32},
                                                                       {"float", Kind::f32},
                                                                       {"double", Kind::f64},
                                                                       {"int8", Kind::i8},
                                                                       {"uint8", Kind::u8},
                                                                       {"int16", Kind::i16},
                                                                       {"uint16", Kind::u16},
                                                                       {"int32", Kind::i32},
                                                                       {"uint32", Kind::u32},
                                                                       {"float32", Kind::f32},
                                                                       {"float64", Kind::f64}}};
    const auto* at = std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry.first == name; });
    return at == known.end() ? std::nullopt : std::optional(at->second);
}

std::size_t size_of(Kind kind) {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(kind)];
}

struct Property {
    std::string name;
    Kind kind = Kind::f32;
    std::optional<Kind> count;  ///< of a list: what its length is written as
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    std::string format;
    std::vector<Element> elements;
};

Kind read_kind(LineReader& lines) {
    const std::string_view word = lines.word();
    const std::optional<Kind> kind = kind_of(word);
    if (!kind) {
        lines.fail("unknown type '" + std::string(word) + "'");
    }
    return *kind;
}

Property read_property(LineReader& lines) {
    Property property;
    std::string_view word = lines.word();
    if (word == "list") {
        property.count = read_kind(lines);
        property.kind = read_kind(lines);
    } else if (const std::optional<Kind> kind = kind_of(word)) {
        property.kind = *kind;
    } else {
        lines.fail("unknown type '" + std::string(word) + "'");
    }
    property.name = lines.word();
    return property;
}

Header read_header(LineReader& lines) {
    Header header;
    if (!lines.next_line() || lines.word() != "ply") {
        lines.fail("is no PLY file: it does not begin with 'ply'");
    }
    while (lines.next_line()) {
        const std::string_view word = lines.word();
        if (word == "format") {
            header.format = lines.word();
        } else if (word == "element") {
            Element& element = header.elements.emplace_back();
            element.name = lines.word();
            element.count = lines.integer("the number of elements");
            if (element.count < 0) {
                lines.fail("a negative number of elements");
            }
        } else if (word == "property") {
            if (header.elements.empty()) {
                lines.fail("a property before the first element");
            }
            header.elements.back().properties.push_back(read_property(lines));
        } else if (word == "end_header") {
            return header;
        } else if (word != "comment" && word != "obj_info") {
            lines.fail("unknown keyword '" + std::string(word) + "'");
        }
    }
    lines.fail("the file ends within its header");
}

/// Numbers from the body, whatever its encoding.
class Body {
public:
    Body(const std::string& file, std::string_view text, LineReader& lines, const std::string& format)
        : file_(file), text_(text), lines_(lines), at_(lines.position()), format_(format) {
        if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian") {
            lines.fail("unknown format '" + format + "'");
        }
    }

    /// Entity \p index of element \p name comes next.
    void begin(const std::string& name, std::int64_t index) {
        name_ = name;
        index_ = index;
        if (ascii() && !lines_.next_line()) {
            fail("the file ends before it");
        }
    }

    double read(Kind kind) { return ascii() ? lines_.number("a property") : read_binary(kind); }

    [[nodiscard]] bool ascii() const { return format_ == "ascii"; }

    [[noreturn]] void fail(const std::string& message) const {
        throw FileError(file_, name_ + " " + std::to_string(index_) + ": " + message, {index_});
    }

private:
    double read_binary(Kind kind) {
        const std::size_t size = size_of(kind);
        if (text_.size() - std::min(at_, text_.size()) < size) {
            fail("the file ends within it");
        }
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t byte = format_ == "binary_big_endian" ? i : size - 1 - i;
            bits = bits << 8U | static_cast<unsigned char>(text_[at_ + byte]);
        }
        at_ += size;
        switch (kind) {
            case Kind::i8: return static_cast<std::int8_t>(bits);
            case Kind::i16: return static_cast<std::int16_t>(bits);
            case Kind::i32: return static_cast<std::int32_t>(bits);
            case Kind::f32: return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
            case Kind::f64: return std::bit_cast<double>(bits);
            case Kind::u8:
            case Kind::u16:
            case Kind::u32: return static_cast<double>(bits);
        }
        return 0.0;
    }

    const std::string& file_;
    std::string_view text_;
    LineReader& lines_;
    std::size_t at_;
    std::string format_;
    std::string name_;
    std::int64_t index_ = 0;
};

class PlyReader {
public:
    explicit PlyReader(Body& body) : body_(body) {}

    void read(const Element& element) {
        if (element.properties.empty() && !body_.ascii()) {
            return;  // nothing stands in the file, however many there are
        }
        for (std::int64_t i = 0; i < element.count; ++i) {
            body_.begin(element.name, i);
            if (element.name == "vertex") {
                read_vertex(element);
            } else {
                read_other(element, element.name == "face");
            }
        }
    }

    PolygonSoup soup;

private:
    void read_vertex(const Element& element) {
        Vec3 x = Vec3::Constant(std::nan(""));
        for (const Property& property : element.properties) {
            if (property.count) {
                read_list(property, [](double) {});
                continue;
            }
            const double value = body_.read(property.kind);
            if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
                x[property.name[0] - 'x'] = value;
            }
        }
        if (!x.allFinite()) {
            body_.fail("a coordinate is missing or not finite");
        }
        soup.nodes.push_back(x);
    }

    void read_other(const Element& element, bool is_face) {
        bool found = false;
        for (const Property& property : element.properties) {
            if (!property.count) {
                static_cast<void>(body_.read(property.kind));
            } else if (is_face && (property.name == "vertex_indices" || property.name == "vertex_index")) {
                found = true;
                const std::size_t corners = read_list(property, [&](double id) {
                    if (!(id >= 0.0 && id < static_cast<double>(soup.nodes.size())) || id != std::floor(id)) {
                        body_.fail("names a vertex that does not exist");
                    }
                    soup.corners.push_back(static_cast<Index>(id));
                });
                if (corners < 3) {
                    body_.fail("less than three corners");
                }
                soup.end_face(0);
            } else {
                read_list(property, [](double) {});
            }
        }
        if (is_face && !found) {
            body_.fail("no list vertex_indices");
        }
    }

    template <class Take>
    std::size_t read_list(const Property& property, Take&& take) {
        const double count = body_.read(*property.count);
        if (!(count >= 0.0 && count <= 1e9)) {
            body_.fail("a list of impossible length");
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            take(body_.read(property.kind));
        }
        return static_cast<std::size_t>(count);
    }

    Body& body_;
};

}  // namespace

PolygonSoup read_ply(const std::string& file, std::string_view text) {
    LineReader lines(file, text, '\0');
    const Header header = read_header(lines);
    Body body(file, text, lines, header.format);
    PlyReader reader(body);
    for (const Element& element : header.elements) {
        if (element.name == "tristrips") {
            lines.fail("triangle strips cannot be read");
        }
        reader.read(element);
    }
    return std::move(reader.soup);
}

}  // namespace pavior::io

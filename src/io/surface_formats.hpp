#pragma once
// The formats behind surface_file.hpp. Own readers: VTK's round coordinates to floats, and none of the others says in
// which line a file is broken.

#include <pavior/mesh/tagged_mesh.hpp>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pavior::io {

/// Polygons as a file has them. Corners of face f: corners[offsets[f]] .. corners[offsets[f + 1] - 1].
struct PolygonSoup {
    std::vector<Vec3> nodes;
    std::vector<Index> corners;
    std::vector<std::size_t> offsets{0};
    std::vector<std::int32_t> tags;  ///< a tag a face
    std::vector<std::string> names;  ///< name of tag k + 1, may be empty; there may be fewer than tags

    void end_face(std::int32_t tag) {
        offsets.push_back(corners.size());
        tags.push_back(tag);
    }
    [[nodiscard]] std::size_t face_count() const { return tags.size(); }
};

/// The contents of \p file are \p text; errors name the file.
PolygonSoup read_stl(const std::string& file, std::string_view text);
PolygonSoup read_obj(const std::string& file, std::string_view text);
PolygonSoup read_off(const std::string& file, std::string_view text);
PolygonSoup read_ply(const std::string& file, std::string_view text);

/// Words of a text, line by line. Words are parted by blanks; what follows \p comment in a line is left out.
class LineReader {
public:
    LineReader(const std::string& file, std::string_view text, char comment)
        : file_(file), text_(text), comment_(comment) {}

    /// Goes to the next line that has a word; false at the end of the text.
    bool next_line();
    /// The next word of this line, empty at its end.
    std::string_view word();
    /// What is left of this line, without blanks at its ends.
    std::string_view rest();
    /// The next word as a finite number; fails if it is none. \p what names it.
    double number(const char* what);
    /// The next word as a whole number.
    std::int64_t integer(const char* what);
    /// Where the text goes on after this line.
    [[nodiscard]] std::size_t position() const { return next_; }
    [[nodiscard]] std::size_t line() const { return line_; }

    /// FileError that names this line.
    [[noreturn]] void fail(const std::string& message) const;

private:
    const std::string& file_;
    std::string_view text_;
    char comment_;
    std::size_t next_ = 0;
    std::size_t line_ = 0;
    std::string_view rest_;
};

/// The whole word as a finite number, or nothing. Not by the locale.
std::optional<double> to_number(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace pavior::io

#include "surface_formats.hpp"

#include <map>
#include <utility>

namespace pavior::io {

namespace {

/// Numbers names from 1 in the order in which they first have a face.
class Names {
public:
    void set(std::string name) {
        name_ = std::move(name);
        number_ = 0;
        named_ = true;
    }
    [[nodiscard]] bool used() const { return named_; }
    /// In the order of their numbers.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    std::int32_t number() {
        if (number_ == 0 && named_) {
            const auto [at, added] = numbers_.emplace(name_, static_cast<std::int32_t>(numbers_.size()) + 1);
            number_ = at->second;
            if (added) {
                names_.push_back(name_);
            }
        }
        return number_;
    }

private:
    std::string name_;
    std::int32_t number_ = 0;
    bool named_ = false;
    std::map<std::string, std::int32_t> numbers_;
    std::vector<std::string> names_;
};

class ObjReader {
public:
    ObjReader(const std::string& file, std::string_view text) : lines_(file, text, '#') {}

    PolygonSoup read() {
        std::vector<std::int32_t> object_tags;
        while (lines_.next_line()) {
            const std::string_view word = lines_.word();
            if (word == "v") {
                read_vertex();
            } else if (word == "f") {
                read_face();
                object_tags.push_back(objects_.number());
            } else if (word == "g") {
                groups_.set(rest());
            } else if (word == "o") {
                objects_.set(rest());
            }
        }
        if (!groups_.used()) {
            soup_.tags = std::move(object_tags);
        }
        soup_.names = (groups_.used() ? groups_ : objects_).names();
        return std::move(soup_);
    }

private:
    std::string rest() {
        std::string name;
        for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word()) {
            name += (name.empty() ? "" : " ") + std::string(word);
        }
        return name;
    }

    void read_vertex() {
        const double x = lines_.number("x");
        const double y = lines_.number("y");
        const double z = lines_.number("z");
        soup_.nodes.emplace_back(x, y, z);
    }

    /// Corners are i, i/j, i//k or i/j/k; negative ones count from the last vertex.
    void read_face() {
        std::size_t corners = 0;
        for (std::string_view word = next_corner(); !word.empty(); word = next_corner(), ++corners) {
            const std::optional<std::int64_t> given = to_integer(word.substr(0, word.find('/')));
            const auto count = static_cast<std::int64_t>(soup_.nodes.size());
            if (!given) {
                lines_.fail("'" + std::string(word) + "' is no corner of a face");
            }
            const std::int64_t id = *given < 0 ? count + *given : *given - 1;
            if (*given == 0 || id < 0 || id >= count) {
                lines_.fail("vertex " + std::to_string(*given) + " does not exist (here)");
            }
            soup_.corners.push_back(static_cast<Index>(id));
        }
        if (corners < 3) {
            lines_.fail("a face with less than three corners");
        }
        soup_.end_face(groups_.number());
    }

    /// A backslash at the end of a line says that it goes on in the next.
    std::string_view next_corner() {
        std::string_view word = lines_.word();
        while (word == "\\") {
            word = lines_.next_line() ? lines_.word() : std::string_view();
        }
        return word;
    }

    LineReader lines_;
    PolygonSoup soup_;
    Names groups_;
    Names objects_;
};

}  // namespace

PolygonSoup read_obj(const std::string& file, std::string_view text) { return ObjReader(file, text).read(); }

}  // namespace pavior::io

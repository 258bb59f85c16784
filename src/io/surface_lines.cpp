#include "surface_formats.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace pavior::io {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

template <class T>
std::optional<T> parsed(std::string_view word) {
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> to_number(std::string_view word) {
    const std::optional<double> value = parsed<double>(word);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view word) { return parsed<std::int64_t>(word); }

bool LineReader::next_line() {
    while (next_ < text_.size()) {
        const std::size_t end = std::min(text_.find('\n', next_), text_.size());
        rest_ = text_.substr(next_, end - next_);
        rest_ = rest_.substr(0, rest_.find(comment_));
        next_ = end + 1;
        ++line_;
        if (rest_.find_first_not_of(blanks) != std::string_view::npos) {
            return true;
        }
    }
    next_ = text_.size();
    rest_ = {};
    return false;
}

std::string_view LineReader::word() {
    const std::size_t begin = std::min(rest_.find_first_not_of(blanks), rest_.size());
    const std::size_t end = std::min(rest_.find_first_of(blanks, begin), rest_.size());
    const std::string_view found = rest_.substr(begin, end - begin);
    rest_ = rest_.substr(end);
    return found;
}

std::string_view LineReader::rest() {
    const std::size_t begin = std::min(rest_.find_first_not_of(blanks), rest_.size());
    const std::string_view found = rest_.substr(begin, rest_.find_last_not_of(blanks) + 1 - begin);
    rest_ = {};
    return found;
}

double LineReader::number(const char* what) {
    const std::string_view found = word();
    const std::optional<double> value = to_number(found);
    if (!value) {
        fail(found.empty() ? std::string(what) + " is missing"
                           : std::string(what) + " is no finite number: '" + std::string(found) + "'");
    }
    return *value;
}

std::int64_t LineReader::integer(const char* what) {
    const std::string_view found = word();
    const std::optional<std::int64_t> value = to_integer(found);
    if (!value) {
        fail(found.empty() ? std::string(what) + " is missing"
                           : std::string(what) + " is no whole number: '" + std::string(found) + "'");
    }
    return *value;
}

void LineReader::fail(const std::string& message) const {
    throw FileError(file_, "line " + std::to_string(line_) + ": " + message, {static_cast<std::int64_t>(line_)});
}

}  // namespace pavior::io

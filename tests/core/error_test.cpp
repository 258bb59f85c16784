#include "support/catch.hpp"

#include <pavior/core/error.hpp>

#include <set>
#include <string>

using pavior::ErrorCode;

TEST_CASE("an error tells its code, its text and the offending ids") {
    const pavior::InputError error(ErrorCode::bad_index, "quad 7 names node 9 of 9", {7});
    CHECK(error.code() == ErrorCode::bad_index);
    CHECK(error.ids() == pavior::Error::Ids{7});
    CHECK(std::string(error.what()) == "bad_index: quad 7 names node 9 of 9");
}

TEST_CASE("a file error names the file") {
    const pavior::FileError error("part.step", "cannot be opened");
    CHECK(error.code() == ErrorCode::unreadable_file);
    CHECK(error.file() == "part.step");
    CHECK(std::string(error.what()) == "unreadable_file: part.step: cannot be opened");
    CHECK(error.ids().empty());
}

TEST_CASE("all errors are caught as Error") {
    CHECK_THROWS_AS(throw pavior::UnmeshableError(ErrorCode::not_sweepable, "face 3"), pavior::Error);
    CHECK_THROWS_AS(throw pavior::InputError(ErrorCode::empty_input, ""), pavior::Error);
    CHECK_THROWS_AS(throw pavior::FileError("", ""), std::runtime_error);
}

TEST_CASE("every code has a name of its own") {
    std::set<std::string_view> names;
    std::size_t codes = 0;
    for (int i = 0; pavior::to_string(static_cast<ErrorCode>(i)) != "unknown"; ++i) {
        names.insert(pavior::to_string(static_cast<ErrorCode>(i)));
        ++codes;
    }
    CHECK(names.size() == codes);
    CHECK(codes >= 23);
    CHECK(pavior::to_string(ErrorCode::null_pseudo_area) == "null_pseudo_area");
    CHECK(pavior::to_string(ErrorCode::inverted_cell) == "inverted_cell");
    CHECK(pavior::to_string(static_cast<ErrorCode>(255)) == "unknown");
}

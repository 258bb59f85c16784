#include "support/catch.hpp"

#include <pavior/core/compiled.hpp>

#include <string_view>

#define PAVIOR_TEST_QUOTE(...) #__VA_ARGS__
#define PAVIOR_TEST_TEXT(...) PAVIOR_TEST_QUOTE(__VA_ARGS__)

namespace {

// Twice defined, as two units would: only what is inline may be.
PAVIOR_INLINE int answer();
PAVIOR_INLINE int answer() { return 42; }

}  // namespace

// Built twice: against the compiled library (test_core) and with headers alone (test_header_only).
TEST_CASE("functions of -inl headers are inline exactly without PAVIOR_COMPILED") {
    constexpr std::string_view text = PAVIOR_TEST_TEXT(PAVIOR_INLINE);
#ifdef PAVIOR_COMPILED
    CHECK(text.empty());
#else
    CHECK(text == "inline");
#endif
    CHECK(answer() == 42);
}

#include "support/catch.hpp"

#include <pavior/affine/method.hpp>

using pavior::AffineMethod;

TEST_CASE("Names of methods and back") {
    for (const auto method : {AffineMethod::constrained, AffineMethod::h, AffineMethod::g, AffineMethod::f}) {
        CHECK(pavior::affine_method_from_string(pavior::to_string(method)) == method);
    }
    CHECK(pavior::to_string(AffineMethod::constrained) == "constrained");
    CHECK(pavior::to_string(AffineMethod::h) == "h");
    CHECK(pavior::to_string(AffineMethod::g) == "g");
    CHECK(pavior::to_string(AffineMethod::f) == "f");
    for (const auto* name : {"", "H", "e", "constrained ", "unknown"}) {
        CHECK_FALSE(pavior::affine_method_from_string(name).has_value());
    }
}

#include "support/catch.hpp"

#include <pavior/affine/fit_result.hpp>

using pavior::ErrorCode;
using pavior::FitStatus;

TEST_CASE("Every failure has the error code of the same name") {
    for (const auto status : {FitStatus::null_pseudo_area, FitStatus::source_degenerate, FitStatus::target_degenerate,
                              FitStatus::unrelated_loops, FitStatus::not_finite}) {
        CHECK(pavior::to_string(pavior::to_error_code(status)) == pavior::to_string(status));
    }
    CHECK(pavior::to_string(FitStatus::ok) == "ok");
}

TEST_CASE("The zero of a correlation is raised to the rounding level of the scalar") {
    CHECK(pavior::detail::unrelated_threshold<double>({}) == 1e-8);
    CHECK(pavior::detail::unrelated_threshold<float>({}) > 1e-6F);
}

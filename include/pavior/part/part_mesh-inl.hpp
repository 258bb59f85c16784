#pragma once

#include <pavior/core/error.hpp>
#include <pavior/part/part_mesh.hpp>

#include <cmath>

namespace pavior {

PAVIOR_INLINE void check_options(const PartOptions& options) {
    const auto check = [](bool good, const std::string& what) {
        if (!good) {
            throw InputError(ErrorCode::bad_option, what);
        }
    };
    check(options.size >= 0 && std::isfinite(options.size), "the size must be positive, or 0 for the default");
    check(options.max_angle >= 1 && options.max_angle <= 90, "the largest angle must be between 1 and 90 degrees");
    check(options.imprint_tolerance >= 0 && std::isfinite(options.imprint_tolerance),
          "the imprint tolerance must be positive, or 0 for none");
    check(options.seconds >= 0 && options.call_seconds >= 0, "time limits must be positive, or 0 for none");
    check(options.max_hexahedra >= 0, "the largest number of hexahedra must be positive, or 0 for no limit");
}

PAVIOR_INLINE std::string reason_of(const PartMesh& part) {
    std::string text;
    for (const PartDecision& decision : part.decisions) {
        if (decision.valid()) {
            continue;
        }
        for (const MethodTry& attempt : decision.tries) {
            text += std::string(to_string(attempt.method)) + ": " + attempt.reason + "\n";
        }
    }
    return text.empty() && !part.check.verify.ok() ? part.check.verify.text() : text;
}

}  // namespace pavior

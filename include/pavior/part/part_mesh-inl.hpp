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
    const auto check_sizes = [&](const auto& sizes) {
        for (const auto& [key, size] : sizes) {
            check(size > 0 && std::isfinite(size), "local sizes must be positive");
        }
    };
    check(options.size >= 0 && std::isfinite(options.size), "the size must be positive, or 0 for the default");
    check(options.max_angle >= 1 && options.max_angle <= 90, "the largest angle must be between 1 and 90 degrees");
    check(options.imprint_tolerance >= 0 && std::isfinite(options.imprint_tolerance),
          "the imprint tolerance must be positive, or 0 for none");
    check(options.seconds >= 0, "the time limit must be positive, or 0 for none");
    check_sizes(options.edge_size);
    check_sizes(options.face_size);
    check_sizes(options.solid_size);
    check_sizes(options.named_size);
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

#pragma once
/// \file
/// Another try with smaller edges where a face between few nodes has no quads.

#include <pavior/core/error.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace pavior::detail {

/// attempt(size, min_loop), and again with smaller sizes and longer loops where a cap between very few nodes admits no
/// quads that are not folded: a few times, and the user is told.
template <class Attempt>
void with_finer_sizes(double size, std::vector<std::string>& warnings, Attempt&& attempt) {
    constexpr int tries = 8;
    for (int i = 1;; ++i) {
        try {
            attempt(size, i == 1 ? 4 : 8);
            return;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::cad_failure || i == tries) {
                throw;
            }
            size *= 0.7;
            std::ostringstream text;
            text << error.what() << "; tried again with size " << size;
            warnings.push_back(text.str());
        }
    }
}

}  // namespace pavior::detail

#pragma once
// What a FileError says without its code and its file.

#include <pavior/core/error.hpp>

#include <string>

namespace pavior::detail {

/// \p what as it is if it does not begin as a FileError of \p file does.
inline std::string bare_message(const std::string& file, const std::string& what) {
    const std::string prefix = FileError(file, "").what();
    return what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what;
}

}  // namespace pavior::detail

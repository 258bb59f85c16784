#pragma once
// What a file name ends with.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace pavior::detail {

/// The extension of \p file in lower case, with its dot; empty if there is none.
inline std::string file_extension(const std::filesystem::path& file) {
    std::string result = file.extension().string();
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

}  // namespace pavior::detail

#pragma once

#include <pavior/io/atomic_file.hpp>

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace pavior::cli {

/// Writes \p json to \p file, whole or not at all; nothing if \p file is empty.
inline void write_report(const std::string& file, const nlohmann::json& json) {
    if (!file.empty()) {
        write_atomically(file, [&](const std::string& temporary) {
            std::ofstream(temporary) << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
        });
    }
}

}  // namespace pavior::cli

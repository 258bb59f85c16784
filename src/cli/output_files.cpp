#include "output_files.hpp"

#include <pavior/core/error.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pavior::cli {

namespace {

namespace fs = std::filesystem;

/// True if both names lead to one file, or would once it is there.
bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error)) {
        return true;
    }
    const auto end_of = [](const std::string& name) {
        std::error_code failed;
        fs::path path = fs::absolute(name, failed);
        for (int links = 0; links < 40 && fs::is_symlink(path, failed); ++links) {
            const fs::path next = fs::read_symlink(path, failed);
            path = next.is_absolute() ? next : path.parent_path() / next;
        }
        return fs::weakly_canonical(path, failed);
    };
    return end_of(a) == end_of(b);
}

}  // namespace

OutputFiles::OutputFiles(const std::string& input, const std::vector<std::string>& outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (outputs[i].empty()) {
            continue;
        }
        if (same_file(outputs[i], input)) {
            throw FileError(outputs[i], "is the input, and would be overwritten");
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (!outputs[j].empty() && same_file(outputs[i], outputs[j])) {
                throw FileError(outputs[i], "is to be written twice, also as " + outputs[j]);
            }
        }
        const AtomicFile possible(outputs[i]);
    }
}

void OutputFiles::write(const std::string& file, const std::function<void(const std::string&)>& write) {
    AtomicFile& whole = files_.emplace_back(file);
    whole.write(write);
    whole.finish();
}

void OutputFiles::write_report(const std::string& file, const nlohmann::json& json) {
    if (file.empty()) {
        return;
    }
    write(file, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
        out.close();
        if (!out) {
            throw FileError(temporary, "could not be written completely");
        }
    });
}

void OutputFiles::commit() {
    for (; !files_.empty(); files_.pop_back()) {
        files_.back().commit();
    }
}

}  // namespace pavior::cli

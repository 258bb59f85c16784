#include "output_files.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pavior::cli {

namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) || fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

}  // namespace

OutputFiles::OutputFiles(const std::string& input, const std::vector<std::string>& outputs) {
    std::vector<std::string> targets;
    for (const std::string& output : outputs) {
        if (output.empty()) {
            continue;
        }
        const std::string target = AtomicFile(output).target();
        if (same_file(target, input)) {
            throw FileError(output, "is the input, and would be overwritten");
        }
        const auto twin = std::find_if(targets.begin(), targets.end(),
                                       [&](const std::string& other) { return same_file(target, other); });
        if (twin != targets.end()) {
            throw FileError(output, "is to be written twice, also as " + *twin);
        }
        targets.push_back(target);
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

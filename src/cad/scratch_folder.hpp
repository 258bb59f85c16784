#pragma once
// A folder of our own for files that pass between two processes. Internal to the cad component.

#include "../common/unfinished.hpp"

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

namespace pavior::detail {

/// An empty folder that nobody else can read, removed with all that is in it at the end of the scope, or of the program
/// by a signal; where none can be made its path is empty.
class ScratchFolder {
public:
    ScratchFolder() {
        std::error_code failure;
        std::string name = (std::filesystem::temp_directory_path(failure) / "pavior-XXXXXX").string();
        if (!failure && mkdtemp(name.data()) != nullptr) {
            path_ = name;
            add_unfinished(name);
        }
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        if (!path_.empty()) {
            std::error_code failure;
            std::filesystem::remove_all(path_, failure);
            const std::scoped_lock lock(unfinished().mutex);
            std::erase(unfinished().places, path_.string());
        }
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace pavior::detail

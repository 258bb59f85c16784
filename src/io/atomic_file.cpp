#include <pavior/io/atomic_file.hpp>

#include <pavior/core/error.hpp>

#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace pavior {

namespace fs = std::filesystem;

namespace {

/// Removes the temporary unless it was renamed.
class Temporary {
public:
    explicit Temporary(fs::path path) : path_(std::move(path)) {}
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

}  // namespace

void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write) {
    const fs::path target(file);
    const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(directory, error)) {
        throw FileError(file, "no such directory: " + directory.string());
    }
    if (fs::is_directory(target, error)) {
        throw FileError(file, "is a directory");
    }
    if (::access(directory.c_str(), W_OK) != 0) {
        throw FileError(file, "cannot write to the directory " + directory.string());
    }
    std::string name = target.stem().string();
    name.insert(0, 1, '.').append(".").append(std::to_string(::getpid())).append(".part").append(target.extension());
    const Temporary temporary(directory / name);
    write(temporary.path().string());
    if (!fs::is_regular_file(temporary.path(), error)) {
        throw FileError(file, "could not be written");
    }
    fs::rename(temporary.path(), target, error);
    if (error) {
        throw FileError(file, "could not be put in place: " + error.message());
    }
}

}  // namespace pavior

#include <pavior/io/atomic_file.hpp>

#include <pavior/core/error.hpp>

#include "../common/unfinished.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace pavior {

namespace fs = std::filesystem;

using detail::unfinished;

namespace {

/// The file that \p file names in the end.
fs::path behind_links(const std::string& file) {
    fs::path target(file);
    std::error_code error;
    for (int links = 0; fs::is_symlink(target, error); ++links) {
        if (links == 40) {
            throw FileError(file, "too many links, or a circle of them");
        }
        const fs::path next = fs::read_symlink(target, error);
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return target;
}

std::string temporary_name(const fs::path& target) {
    static std::atomic<unsigned> count{0};
    std::string name = "." + target.stem().string();
    name.append(".").append(std::to_string(::getpid())).append("-").append(std::to_string(count++)).append(".part");
    return target.parent_path() / name.append(target.extension().string());
}

}  // namespace

AtomicFile::AtomicFile(const std::string& file) : file_(file) {
    const fs::path target = behind_links(file);
    const fs::path directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(directory, error)) {
        throw FileError(file, "no such directory: " + directory.string());
    }
    const fs::file_status there = fs::status(target, error);
    if (fs::is_directory(there)) {
        throw FileError(file, "is a directory");
    }
    if (fs::exists(there) && !fs::is_regular_file(there)) {
        throw FileError(file, "is no regular file");
    }
    if (::access(directory.c_str(), W_OK) != 0) {
        throw FileError(file, "cannot write to the directory " + directory.string());
    }
    target_ = target.string();
    temporary_ = temporary_name(target);
    detail::add_unfinished(temporary_);
}

AtomicFile::~AtomicFile() {
    const std::scoped_lock lock(unfinished().mutex);
    std::erase(unfinished().places, temporary_);
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void AtomicFile::write(const std::function<void(const std::string&)>& write) const {
    try {
        write(temporary_);
    } catch (const FileError& error) {
        if (error.file() != temporary_) {
            throw;
        }
        const std::string text = error.what();
        const std::size_t message = text.find(temporary_) + temporary_.size() + 2;
        throw FileError(file_, text.substr(std::min(message, text.size())), error.ids());
    }
}

void AtomicFile::finish() {
    std::error_code error;
    if (!fs::is_regular_file(temporary_, error)) {
        throw FileError(file_, "could not be written");
    }
    const int descriptor = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool arrived = descriptor >= 0 && ::fsync(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0) {
        ::close(descriptor);
    }
    if (!arrived) {
        throw FileError(file_, std::string("could not be written to the disk: ") + std::strerror(reason));
    }
    finished_ = true;
}

void AtomicFile::commit() {
    if (!finished_) {
        finish();
    }
    const std::scoped_lock lock(unfinished().mutex);
    std::error_code error;
    if (unfinished().closed) {
        throw FileError(file_, "not put in place: the program is ending");
    }
    fs::rename(temporary_, target_, error);
    if (error) {
        throw FileError(file_, "could not be put in place: " + error.message());
    }
}

void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write) {
    AtomicFile whole(file);
    whole.write(write);
    whole.commit();
}

void discard_unfinished_files() noexcept {
    detail::Unfinished& all = unfinished();
    const std::scoped_lock lock(all.mutex);
    all.closed = true;
    for (const std::string& place : all.places) {
        std::error_code ignored;
        fs::remove_all(place, ignored);
    }
}

}  // namespace pavior

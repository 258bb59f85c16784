#include "checked_output.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace pavior::io {

namespace {
constexpr std::size_t buffer_size = std::size_t{1} << 20U;
}  // namespace

CheckedOutput::CheckedOutput(const std::string& path, std::string shown)
    : shown_(std::move(shown)), buffer_(buffer_size) {
    file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) {
        throw FileError(shown_, "cannot be opened for writing: " + std::string(std::strerror(errno)));
    }
}

CheckedOutput::~CheckedOutput() {
    if (file_ >= 0) {
        ::close(file_);
    }
}

void CheckedOutput::fail() {
    throw FileError(shown_, "could not be written completely: " + std::string(std::strerror(error_)));
}

void CheckedOutput::drain() {
    for (std::size_t done = 0; done < used_;) {
        const ssize_t wrote = error_ != 0 ? -1 : ::write(file_, buffer_.data() + done, used_ - done);
        if (wrote < 0) {
            if (error_ == 0 && errno == EINTR) {
                continue;
            }
            error_ = error_ != 0 ? error_ : errno;
            used_ = 0;
            fail();
        }
        done += static_cast<std::size_t>(wrote);
    }
    used_ = 0;
}

char* CheckedOutput::room(std::size_t size) {
    if (used_ + size > buffer_.size()) {
        drain();
    }
    return buffer_.data() + used_;
}

void CheckedOutput::bytes(const void* data, std::size_t size) {
    const auto* at = static_cast<const char*>(data);
    while (size > 0) {
        char* const to = room(1);
        const std::size_t now = std::min(size, buffer_.size() - used_);
        std::memcpy(to, at, now);
        used_ += now;
        at += now;
        size -= now;
    }
}

void CheckedOutput::finish() {
    drain();
    if (error_ == 0 && file_ >= 0 && ::close(std::exchange(file_, -1)) != 0 && errno != EINTR) {
        error_ = errno;
    }
    if (error_ != 0) {
        fail();
    }
}

std::streamsize CheckedOutput::xsputn(const char* data, std::streamsize size) {
    bytes(data, static_cast<std::size_t>(size));
    return size;
}

CheckedOutput::int_type CheckedOutput::overflow(int_type c) {
    if (!traits_type::eq_int_type(c, traits_type::eof())) {
        const char byte = traits_type::to_char_type(c);
        bytes(&byte, 1);
    }
    return traits_type::not_eof(c);
}

int CheckedOutput::sync() {
    drain();
    return 0;
}

CheckedOutput::pos_type CheckedOutput::seekoff(off_type offset, std::ios_base::seekdir from,
                                               std::ios_base::openmode /*which*/) {
    if (offset == 0 && from == std::ios_base::cur) {  // tellp(): no need to write first
        const off_t here = ::lseek(file_, 0, SEEK_CUR);
        return here < 0 ? pos_type(off_type(-1)) : pos_type(here + static_cast<off_t>(used_));
    }
    drain();
    const int whence = from == std::ios_base::beg ? SEEK_SET : from == std::ios_base::cur ? SEEK_CUR : SEEK_END;
    return {::lseek(file_, offset, whence)};
}

CheckedOutput::pos_type CheckedOutput::seekpos(pos_type position, std::ios_base::openmode which) {
    return seekoff(off_type(position), std::ios_base::beg, which);
}

}  // namespace pavior::io

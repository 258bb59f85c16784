#pragma once
// A file that is written whole or said not to be: every byte is accounted for until finish() returns.

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <streambuf>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pavior::io {

/// Buffered output to a new file. A write that fails throws FileError; behind a std::ostream, which swallows
/// exceptions, it is finish() that throws.
class CheckedOutput : public std::streambuf {
public:
    /// \param path   the file, made or emptied
    /// \param shown  its name in errors
    CheckedOutput(const std::string& path, std::string shown);
    CheckedOutput(const CheckedOutput&) = delete;
    CheckedOutput& operator=(const CheckedOutput&) = delete;
    ~CheckedOutput() override;

    /// What the file is called in errors.
    [[nodiscard]] const std::string& name() const { return shown_; }

    void text(std::string_view text) { bytes(text.data(), text.size()); }
    void bytes(const void* data, std::size_t size);

    /// The bytes of a number as they are in memory.
    template <class Value>
    requires std::is_arithmetic_v<Value>
    void raw(Value value) { bytes(&value, sizeof value); }

    /// A number in decimal digits.
    template <std::integral Value>
    void number(Value value) {
        char* const at = room(24);
        used_ += static_cast<std::size_t>(std::to_chars(at, at + 24, value).ptr - at);
    }
    /// With the digits that give it back exactly: as few as possible.
    void number(double value) {
        char* const at = room(32);
        used_ += static_cast<std::size_t>(std::to_chars(at, at + 32, value).ptr - at);
    }
    /// With \p digits digits, as printf's %.17g does.
    void number(double value, int digits) {
        char* const at = room(48);
        const auto end = std::to_chars(at, at + 48, value, std::chars_format::general, digits).ptr;
        used_ += static_cast<std::size_t>(end - at);
    }

    /// Writes what is left and closes the file; nothing if that was done.
    /// \throws FileError if any byte was lost, now or before
    void finish();

protected:
    std::streamsize xsputn(const char* data, std::streamsize size) override;
    int_type overflow(int_type c) override;
    int sync() override;
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
    pos_type seekpos(pos_type position, std::ios_base::openmode which) override;

private:
    /// A place for so many bytes in the buffer.
    char* room(std::size_t size);
    void drain();
    [[noreturn]] void fail();

    int file_ = -1;
    int error_ = 0;  ///< the errno of the first failure
    std::string shown_;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
};

}  // namespace pavior::io

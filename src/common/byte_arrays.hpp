#pragma once
// Arrays of plain values as a string of bytes and back, for messages between two processes of one program.

#include <pavior/core/assert.hpp>
#include <pavior/math/point.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace pavior::detail {

/// Values that their bytes say in full: trivially copyable ones, and Vec3.
template <class Value>
concept byte_value = std::is_trivially_copyable_v<Value> || std::is_same_v<Value, Vec3>;

/// Appends arrays (anything with size() and data()) to a message: the count as 64 bits, then the values.
class ByteWriter {
public:
    template <class Array>
    requires byte_value<typename Array::value_type>
    void add(const Array& array) {
        const std::uint64_t count = array.size();
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(typename Array::value_type));
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Takes the arrays of a message in the order in which they were added. The message must outlive the reader.
class ByteReader {
public:
    explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

    template <class Array>
    requires byte_value<typename Array::value_type>
    void get(Array& array) {
        std::uint64_t count = 0;
        copy(&count, sizeof count);
        array.resize(count);
        copy(array.data(), array.size() * sizeof(typename Array::value_type));
    }

private:
    void copy(void* to, std::size_t size) {
        PAVIOR_ASSERT(size <= bytes_.size() - at_);
        if (size > 0) {
            std::memcpy(to, bytes_.data() + at_, size);
        }
        at_ += size;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

}  // namespace pavior::detail

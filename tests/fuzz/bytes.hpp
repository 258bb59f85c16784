#pragma once
// Numbers out of the bytes that a fuzzer makes up.

#include <cstddef>
#include <cstdint>

namespace pavior::fuzz {

/// Hands out the bytes one by one; zeros when they are used up.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

    [[nodiscard]] bool empty() const { return at_ == end_; }
    std::uint8_t byte() { return empty() ? 0 : *at_++; }
    /// 0 .. below - 1, below <= 256.
    std::size_t below(std::size_t below) { return byte() % below; }
    /// Between -1 and 1 in steps of 1/127, or now and then something that is no sensible number.
    double number() {
        const std::uint8_t value = byte();
        if (value == 255) {
            constexpr double odd[] = {
                0.0, -0.0, 1e-300, 1e300, -1e300, __builtin_inf(), -__builtin_inf(), __builtin_nan("")};
            return odd[below(8)];
        }
        return (static_cast<double>(value) - 127) / 127;
    }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

/// Ends the program, for libFuzzer to note the input, if \p holds is false.
inline void require(bool holds) {
    if (!holds) {
        __builtin_trap();
    }
}

}  // namespace pavior::fuzz

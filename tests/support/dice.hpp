#pragma once
// Random numbers that do not depend on the standard library, and seeds that the environment may prescribe.
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace pavior::test {

class Dice {
public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double real(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }
    int whole(int low, int high) { return low + static_cast<int>(real(0, 1) * (high - low + 1)); }
    int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
    bool coin() { return below(2) == 0; }

private:
    std::mt19937 engine_;
};

struct Seeds {
    unsigned first = 1, count = 1;
    [[nodiscard]] unsigned last() const { return first + count - 1; }
};

/// 1 to \p usual, or what the environment variable says: first:count.
inline Seeds seeds(const char* variable, unsigned usual) {
    const char* given = std::getenv(variable);
    if (given == nullptr) {
        return {1, usual};
    }
    const std::string text = given;
    return {static_cast<unsigned>(std::stoul(text)),
            static_cast<unsigned>(std::stoul(text.substr(text.find(':') + 1)))};
}

}  // namespace pavior::test

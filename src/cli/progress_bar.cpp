#include "progress_bar.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include <unistd.h>

namespace pavior::cli {

ProgressBar::ProgressBar(bool quiet) : shown_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    if (!last_.empty()) {
        std::fputs("\r\033[K", stderr);
    }
}

Progress ProgressBar::sink() {
    if (!shown_) {
        return {};
    }
    return [this](std::string_view stage, double fraction) { draw(stage, fraction); };
}

void ProgressBar::draw(std::string_view stage, double fraction) {
    constexpr std::size_t width = 30;
    const double clamped = std::clamp(fraction, 0.0, 1.0);
    const auto full = static_cast<std::size_t>(clamped * static_cast<double>(width));
    std::ostringstream text;
    text << '[' << std::string(full, '#') << std::string(width - full, ' ') << "] " << static_cast<int>(100 * clamped)
         << " % " << stage;
    std::string line = text.str();
    if (line != last_) {
        std::fprintf(stderr, "\r\033[K%s", line.c_str());
        std::fflush(stderr);
        last_ = std::move(line);
    }
}

}  // namespace pavior::cli

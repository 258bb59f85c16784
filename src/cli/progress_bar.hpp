#pragma once

#include <pavior/core/progress.hpp>

#include <string>

namespace pavior::cli {

/// A bar on stderr while it lives, if stderr is a terminal and the user did not ask for silence; nothing otherwise.
class ProgressBar {
public:
    explicit ProgressBar(bool quiet);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();

    /// To hand to algorithms; empty if nothing is to be shown. Must not outlive the bar.
    [[nodiscard]] Progress sink();

private:
    void draw(std::string_view stage, double fraction);

    bool shown_;
    std::string last_;
};

}  // namespace pavior::cli

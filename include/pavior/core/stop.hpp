#pragma once
/// \file
/// How a long call is stopped: the caller asks by a std::stop_source, the call ends by an exception.

#include <cstddef>
#include <exception>
#include <iterator>
#include <stop_token>
#include <utility>

namespace pavior {

/// Thrown by a call that was asked to stop. What the call was to write in place is as before the call, unless its
/// comment says otherwise; nothing else is left behind. No Error, since nothing went wrong: code that catches Error to
/// try another way must let it pass.
class Stopped : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "stopped: the caller asked for it"; }
};

/// Ends the call if \p stop asks for it; a token without a source never does. A read of one atomic: cheap enough for
/// each item of work that takes a microsecond. Thread-safe. \throws Stopped
inline void check_stop(const std::stop_token& stop) {
    if (stop.stop_requested()) {
        throw Stopped();
    }
}

/// A range that checks a token before its first and after every 1024th item, for loops whose items take less than a
/// few microseconds: `for (const Index f : stoppable(IndexRange(n), stop))`.
template <class Range>
class Stoppable {
    using Base = decltype(std::begin(std::declval<const Range&>()));

public:
    class Iterator {
    public:
        Iterator(Base at, const std::stop_token& stop) : at_(at), stop_(&stop) {}
        decltype(auto) operator*() const { return *at_; }
        Iterator& operator++() {
            ++at_;
            if ((++count_ & 1023U) == 0) {
                check_stop(*stop_);
            }
            return *this;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

    private:
        Base at_;
        const std::stop_token* stop_;
        std::size_t count_ = 0;
    };

    Stoppable(Range range, const std::stop_token& stop) : range_(range), stop_(stop) {}

    [[nodiscard]] Iterator begin() const {
        check_stop(stop_);
        return {std::begin(range_), stop_};
    }
    [[nodiscard]] Iterator end() const { return {std::end(range_), stop_}; }

private:
    Range range_;
    const std::stop_token& stop_;
};

/// \p range, a view that is cheap to copy (IndexRange, std::span), with checks of \p stop, which must outlive it.
/// \throws Stopped from its iterators
template <class Range>
[[nodiscard]] Stoppable<Range> stoppable(Range range, const std::stop_token& stop) {
    return {range, stop};
}
template <class Range>
Stoppable<Range> stoppable(Range range, const std::stop_token&& stop) = delete;

}  // namespace pavior

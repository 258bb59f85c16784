#pragma once
/// \file
/// Node and cell ids of meshes, and a range over them.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace pavior {

/// Id of a node or cell in a mesh: 0-based, dense.
using Index = std::uint32_t;

/// No node or cell.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// No position in an array.
inline constexpr std::size_t no_position = std::numeric_limits<std::size_t>::max();

/// The half-open range of ids [first, last), iterable and sized. (clang 14 cannot compile std::views::iota.)
class IndexRange {
public:
    class Iterator {
    public:
        using value_type = Index;
        using difference_type = std::ptrdiff_t;
        constexpr Iterator() = default;
        constexpr explicit Iterator(Index at) : at_(at) {}
        constexpr Index operator*() const { return at_; }
        constexpr Iterator& operator++() {
            ++at_;
            return *this;
        }
        constexpr Iterator operator++(int) {
            Iterator old = *this;
            ++at_;
            return old;
        }
        friend constexpr bool operator==(Iterator, Iterator) = default;

    private:
        Index at_ = 0;
    };

    constexpr explicit IndexRange(std::size_t last) : last_(static_cast<Index>(last)) {}
    constexpr IndexRange(Index first, Index last) : first_(first), last_(last) {}

    [[nodiscard]] constexpr Iterator begin() const { return Iterator(first_); }
    [[nodiscard]] constexpr Iterator end() const { return Iterator(last_); }
    [[nodiscard]] constexpr std::size_t size() const { return last_ - first_; }

private:
    Index first_ = 0;
    Index last_ = 0;
};

/// Strongly typed id: `Id<struct FaceTag>` and `Id<struct EdgeTag>` do not convert into each other.
template <class Tag>
struct Id {
    std::int32_t value = -1;

    [[nodiscard]] constexpr bool valid() const { return value >= 0; }
    [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
    friend constexpr auto operator<=>(Id, Id) = default;
};

}  // namespace pavior

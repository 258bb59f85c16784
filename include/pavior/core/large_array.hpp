#pragma once
/// \file
/// Memory of arrays that are written once and are larger than the caches.

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pavior {

/// An empty vector with room for \p count elements, backed by huge pages where the system grants them on request:
/// filling many small pages costs more than computing what goes into them. A hint only, without effect on arrays below
/// 8 MB and outside Linux. \throws std::bad_alloc, std::length_error as std::vector::reserve
template <class T>
[[nodiscard]] std::vector<T> large_array(std::size_t count) {
    std::vector<T> array;
    array.reserve(count);
#if defined(__linux__)
    constexpr std::uintptr_t page = 4096;
    const std::size_t bytes = count * sizeof(T);
    if (bytes >= (std::size_t{8} << 20)) {
        const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(array.data());
        const std::uintptr_t first = (begin + page - 1) / page * page;
        madvise(reinterpret_cast<void*>(first), (begin + bytes - first) / page * page, MADV_HUGEPAGE);
    }
#endif
    return array;
}

}  // namespace pavior

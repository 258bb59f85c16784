#include "support/catch.hpp"

#include <pavior/core/large_array.hpp>

#include <cstdint>
#include <numeric>
#include <vector>

TEST_CASE("a large array starts empty and takes its elements without moving") {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{3000001}}) {
        std::vector<double> array = pavior::large_array<double>(count);
        CHECK(array.empty());
        REQUIRE(array.capacity() >= count);
        const double* const first = array.data();
        array.resize(count);
        std::iota(array.begin(), array.end(), 0.0);
        CHECK(array.data() == first);
        CHECK(std::accumulate(array.begin(), array.end(), 0.0) ==
              0.5 * static_cast<double>(count) * (static_cast<double>(count) - 1.0) * (count == 0 ? 0.0 : 1.0));
    }
}

TEST_CASE("what no machine holds is an exception") {
    CHECK_THROWS_AS(pavior::large_array<double>(SIZE_MAX / 4), std::length_error);
}

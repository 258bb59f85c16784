#pragma once
/// \file
/// Both caps of a sweep laid out for the node kernel.

#include <pavior/math/point.hpp>
#include <pavior/sweep/node_kernel.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace pavior::detail {

/// Six rows of n values, x, y, z of the source nodes and x, y, z of the target nodes, each cap relative to its centre.
/// Rows start at multiples of 64 bytes. Copies share the (constant) array.
class CapArray {
public:
    CapArray() = default;
    CapArray(std::span<const Vec3> source, std::span<const Vec3> target, const Vec3& source_centre,
             const Vec3& target_centre) {
        constexpr std::size_t line = 8;
        // An odd number of lines a row, so that rows do not compete for the same cache sets.
        const std::size_t stride = ((source.size() / line + 1) | 1) * line;
        auto values = std::make_shared<std::vector<double>>(6 * stride + line, 0.0);
        double* first = values->data();
        while (reinterpret_cast<std::uintptr_t>(first) % 64 != 0) {
            ++first;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const auto axis = static_cast<Eigen::Index>(c);
            for (std::size_t i = 0; i < source.size(); ++i) {
                first[c * stride + i] = source[i][axis] - source_centre[axis];
                first[(c + 3) * stride + i] = target[i][axis] - target_centre[axis];
            }
        }
        for (std::size_t s = 0; s < 6; ++s) {
            rows_.row[s] = first + s * stride;
        }
        values_ = std::move(values);
    }

    [[nodiscard]] const CapCoordinates& rows() const { return rows_; }

private:
    std::shared_ptr<const std::vector<double>> values_;
    CapCoordinates rows_;
};

}  // namespace pavior::detail

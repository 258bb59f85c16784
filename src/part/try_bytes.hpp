#pragma once

#include <pavior/part/part_mesh.hpp>

#include <string>

namespace pavior::detail {

/// \p result as bytes, to be carried from one process of this program to another; and back.
[[nodiscard]] std::string to_bytes(const MethodTry& result);
[[nodiscard]] MethodTry try_from_bytes(const std::string& bytes);

}  // namespace pavior::detail

#pragma once
// Readers of foreign code in a process of their own: a broken file makes Gmsh and VTK crash, hang or leak.

#include "../common/byte_arrays.hpp"

#include <functional>
#include <string>

namespace pavior::io {

/// Runs \p read in a process of its own; returns what it added. Given up after 10 s and one more for each 100 kB of the
/// file. FileErrors pass through with their ids.
/// \throws FileError as \p read does, or: it threw, it did not come back, or its process died
std::string read_apart(const std::string& file, const std::function<void(detail::ByteWriter&)>& read);

}  // namespace pavior::io

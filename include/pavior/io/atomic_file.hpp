#pragma once
/// \file
/// Files that appear whole or not at all.

#include <functional>
#include <string>

namespace pavior {

/// Calls write(temporary) with a name in the directory of \p file and with its extension, then renames the result to
/// \p file. If \p write throws or leaves nothing behind, the temporary is removed and \p file stays as it was.
/// \throws FileError if the directory cannot be written to; whatever \p write throws
void write_atomically(const std::string& file, const std::function<void(const std::string& temporary)>& write);

}  // namespace pavior

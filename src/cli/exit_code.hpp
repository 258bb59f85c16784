#pragma once

namespace pavior::cli {

/// What the program tells its caller. Stable: scripts rely on the numbers.
enum ExitCode : int {
    exit_valid = 0,        ///< a valid mesh was written (or read)
    exit_invalid = 1,      ///< a mesh was made, but it is not valid
    exit_bad_input = 2,    ///< bad input or options
    exit_not_meshable = 3  ///< sound input that this method cannot mesh
};

}  // namespace pavior::cli

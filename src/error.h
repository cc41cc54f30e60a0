/// The three ways a run can end badly, one type for each exit code of the command line.
#pragma once

#include <stdexcept>
#include <string>

namespace thermocontact {

/// The scene or the command line is wrong (exit code 2). The message names file, line, key and expectation.
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The system failed: files, memory (exit code 1).
struct SystemError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The numerics failed: no convergence, singular system, non-finite value (exit code 3). The message names
/// the step, the equation, what was tried and what to change.
struct NumericsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace thermocontact

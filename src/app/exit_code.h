/// Exit codes of the program (INTERFACE.md).
#pragma once

namespace thermocontact::app {

inline constexpr int exit_completed = 0;
inline constexpr int exit_system_failed = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_numerics_failed = 3;

/// 130 for SIGINT, 143 for SIGTERM.
constexpr int exit_of_signal(int signal) {
    return 128 + signal;
}

}  // namespace thermocontact::app

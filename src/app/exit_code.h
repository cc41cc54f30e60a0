/// Exit codes of the program (INTERFACE.md).
#pragma once

#include <array>
#include <csignal>

namespace thermocontact::app {

inline constexpr int exit_completed = 0;
inline constexpr int exit_system_failed = 1;
inline constexpr int exit_bad_input = 2;
inline constexpr int exit_numerics_failed = 3;

/// 130 for SIGINT, 143 for SIGTERM.
constexpr int exit_of_signal(int signal) {
    return 128 + signal;
}

/// What an exit code says, for the manual.
struct ExitCode {
    int code;
    const char* meaning;
    const char* left;  ///< what the user gets
};

inline constexpr std::array<ExitCode, 6> exit_codes{{
    {exit_completed, "completed", "results and summary"},
    {exit_system_failed, "the system failed: disk full, out of memory, MPI",
     "one line with the reason on the standard error; earlier results as they were"},
    {exit_bad_input, "the scene or the command line is wrong",
     "file, line and key at fault, what was expected, the nearest valid name; nothing run, nothing written"},
    {exit_numerics_failed,
     "the numerics failed: no convergence at the smallest step, a singular system, a value that is not "
     "finite, a "
     "request for an accuracy or a time that cannot be met",
     "step and equation, what was tried, what to change; every completed step, a checkpoint, and status "
     "\"failed\" in "
     "the summary"},
    {exit_of_signal(SIGINT), "interrupted (SIGINT, Ctrl-C)",
     "every completed step, a checkpoint, and status \"interrupted\" in the summary"},
    {exit_of_signal(SIGTERM), "terminated (SIGTERM)", "the same"},
}};

}  // namespace thermocontact::app

/// Another program, run to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace thermocontact::laws {

/// Starts words[0], sought on PATH, with what it prints going to two files; returns its exit code, 128 + n
/// where signal n ended it. Throws SystemError where it cannot be started.
int run_program(const std::vector<std::string>& words, const std::filesystem::path& output,
                const std::filesystem::path& errors);

}  // namespace thermocontact::laws

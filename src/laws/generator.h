/// forms/generate.py at run time: from law files to what they say of themselves and to compiled kernels.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "laws/law_file.h"

namespace thermocontact::laws {

/// Python, forms and compiler that are used: what is made depends on them.
std::string generator_identity();

/// Writes the JSON of forms/describe.py into the folder; returns the file.
std::filesystem::path make_description(const LawFile& file, const std::filesystem::path& folder);

/// Writes a shared library with the kernels into the folder; returns the file. Both throw SceneError
/// "FILE:LINE: why" where a law file is at fault and SystemError where Python, FFCx or the compiler are.
std::filesystem::path make_library(const std::vector<LawFile>& files, const Target& target,
                                   const std::filesystem::path& folder);

}  // namespace thermocontact::laws

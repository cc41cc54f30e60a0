/// Law files of a scene's own: UFL that takes the place of a law of forms/laws.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/kernel_table.h"
#include "laws/description.h"

namespace thermocontact::laws {

struct LawFile {
    std::string kind;  ///< "compliance"
    std::filesystem::path path;
    std::string text;
    std::string digest;  ///< SHA-256 of the text
};

/// Throws SceneError where it cannot be read or is no text file of a sensible size.
LawFile read_law_file(const std::string& kind, const std::filesystem::path& path);

/// What the file says of itself, by forms/describe.py unless the cache knows. Throws SceneError "FILE:LINE:
/// why" where it cannot be a law, SystemError where Python or FFCx are missing.
Description describe(const LawFile& file);

/// What kernels are compiled for.
struct Target {
    std::string cell;  ///< "triangle"
    int degree = 1;
    bool plane_strain = false;  ///< of bodies in 2D; else plane stress
};

/// The kernels of every form that one of the files enters: generated, compiled and kept, or as kept. They
/// stay loaded as long as the program runs. Throws as describe(), and SystemError where there is no C
/// compiler.
std::span<const thermocontact_kernel> kernels(const std::vector<LawFile>& files, const Target& target);

}  // namespace thermocontact::laws

/// What it takes to write results where they are to go: a disk, another machine's, memory.
#pragma once

#include <filesystem>

namespace thermocontact::plan {

/// s: to make a run's folder, checkpoints and summary; the files of one output of fields, whatever their
/// size. As measured on a disk.
struct Writing {
    double folder = 5e-3, files = 6e-4;
};

/// Measured in a folder that is made beside `results`, whether that is there or not, and removed; what is
/// true of a disk where nothing can be written.
Writing measured_writing(const std::filesystem::path& results);

}  // namespace thermocontact::plan

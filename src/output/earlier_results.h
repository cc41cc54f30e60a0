/// What an earlier run left in a results folder: to be removed, or to be continued. A run that was killed may
/// have left a row cut short, fields that no collection names, and files that were being written.
#pragma once

#include <filesystem>
#include <vector>

#include "output/vtu.h"

namespace thermocontact::output {

/// Removes what an earlier run left, and nothing else: the checkpoint first, which the rest belongs to.
void clear_results(const std::filesystem::path& folder);

/// Keeps of history.csv or steps.csv the rows up to `step`, which are whole; false if there is not even a
/// header.
bool keep_rows(const std::filesystem::path& file, int step);

/// Keeps the fields up to `step`, those of `step` itself only if `with_last`; returns their entries in
/// fields.pvd, which is not written.
std::vector<PvdEntry> keep_fields(const std::filesystem::path& folder, int step, bool with_last);

}  // namespace thermocontact::output

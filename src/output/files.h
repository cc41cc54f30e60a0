/// Files that stand whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace thermocontact::output {

/// Whether a file is to survive a crash of the machine, too: writing then waits for the disk.
enum class Sync { no, yes };

/// Writes `content` beside `path` and renames it over. Throws SystemError naming the file and the reason.
void write_whole(const std::filesystem::path& path, std::string_view content, Sync sync = Sync::no);

/// Makes the folder and its parents; whether there was none. Throws SystemError if it, or a folder `fields`
/// in it, cannot be written to, or the disk has no room for a file of 64 KiB: before anything goes that an
/// earlier run left.
bool make_folder(const std::filesystem::path& folder);

}  // namespace thermocontact::output

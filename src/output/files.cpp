#include "output/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "error.h"

namespace thermocontact::output {
namespace {

/// Waits until the disk has what was written to `path`; false with errno where that fails.
bool reaches_disk(const std::filesystem::path& path, int how) {
    const int file = ::open(path.c_str(), how | O_CLOEXEC);
    if (file < 0) {
        return false;
    }
    const bool done = ::fsync(file) == 0;
    const int reason = errno;
    ::close(file);
    errno = reason;
    return done;
}

constexpr std::size_t least_room = 1 << 16;  ///< bytes that must find a place on the disk

}  // namespace

void write_whole(const std::filesystem::path& path, std::string_view content, Sync sync) {
    const std::filesystem::path beside = path.string() + ".part";
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw SystemError("cannot write " + path.string() + ": " + reason);
    };
    errno = 0;
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file || (sync == Sync::yes && !reaches_disk(beside, O_WRONLY))) {
        fail(std::strerror(errno != 0 ? errno : EIO));
    }
    std::error_code failure;
    std::filesystem::rename(beside, path, failure);
    if (failure) {
        fail(failure.message());
    }
    if (sync == Sync::yes) {  // the new name, where the file system can promise it
        const std::filesystem::path folder = path.parent_path();
        reaches_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
    }
}

bool make_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    const bool made = std::filesystem::create_directories(folder, failure);
    if (failure) {
        throw SystemError("cannot make the output folder " + folder.string() + ": " + failure.message());
    }
    const auto refuse = [](const std::filesystem::path& path) {
        throw SystemError("cannot write to the output folder " + path.string() + ": " +
                          std::strerror(errno != 0 ? errno : EIO));
    };
    for (const std::filesystem::path& path : {folder, folder / "fields"}) {
        if (::access(path.c_str(), W_OK | X_OK) != 0 && errno != ENOENT) {
            refuse(path);
        }
    }
    const std::filesystem::path trial = folder / "room.part";
    errno = 0;
    std::ofstream file(trial, std::ios::binary | std::ios::trunc);
    file.write(std::string(least_room, '\0').data(), static_cast<std::streamsize>(least_room));
    file.close();
    const int reason = errno;
    std::error_code ignored;
    std::filesystem::remove(trial, ignored);
    if (!file) {
        errno = reason;
        refuse(folder);
    }
    return made;
}

}  // namespace thermocontact::output

#include "output/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "error.h"

namespace thermocontact::output {

void write_whole(const std::filesystem::path& path, std::string_view content) {
    const std::filesystem::path beside = path.string() + ".part";
    errno = 0;
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) {
        const int reason = errno;
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw SystemError("cannot write " + path.string() + ": " + std::strerror(reason != 0 ? reason : EIO));
    }
    std::error_code failure;
    std::filesystem::rename(beside, path, failure);
    if (failure) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw SystemError("cannot write " + path.string() + ": " + failure.message());
    }
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure) {
        throw SystemError("cannot make the output folder " + folder.string() + ": " + failure.message());
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw SystemError("cannot write to the output folder " + folder.string() + ": " +
                          std::strerror(errno));
    }
}

}  // namespace thermocontact::output

#include "output/folder_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "error.h"
#include "output/files.h"
#include "parallel/together.h"

namespace thermocontact::output {

FolderClaim::FolderClaim(std::filesystem::path folder, const parallel::Team& team)
    : folder_(std::move(folder)) {
    parallel::together(team, [&] {
        if (team.rank() == 0) {
            made_ = make_folder(folder_);
            claim();
        }
    });
}

FolderClaim::FolderClaim(FolderClaim&& other) noexcept
    : folder_(std::move(other.folder_)),
      file_(std::exchange(other.file_, -1)),
      made_(std::exchange(other.made_, false)) {}

FolderClaim::~FolderClaim() {
    if (made_ && is_there()) {
        std::error_code not_empty;
        std::filesystem::remove(folder_, not_empty);
    }
    if (file_ >= 0) {
        ::close(file_);
    }
}

/// A lock on the folder itself leaves no file behind. Network file systems may not have it.
void FolderClaim::claim() {
    file_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(std::exchange(file_, -1));
        throw SystemError("another run writes to the output folder " + folder_.string() +
                          "; wait for its end, or give this one another folder with --output");
    }
}

bool FolderClaim::is_there() const {
    struct stat claimed {
    }, there{};
    if (file_ < 0 || ::fstat(file_, &claimed) != 0) {
        return true;
    }
    return ::stat(folder_.c_str(), &there) == 0 && there.st_ino == claimed.st_ino &&
           there.st_dev == claimed.st_dev;
}

void FolderClaim::require() const {
    if (!is_there()) {
        throw SystemError("the output folder " + folder_.string() +
                          " was removed or replaced during the run");
    }
}

}  // namespace thermocontact::output

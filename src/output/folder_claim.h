/// A results folder while a run writes to it: no other run may, and it has to stay where it is.
#pragma once

#include <filesystem>

#include "parallel/team.h"

namespace thermocontact::output {

class FolderClaim {
  public:
    /// Makes the folder and its parents, and claims it until the object or the process ends, however it ends.
    /// What it made goes with it if nothing has been written there.
    /// Every process must call; the first one does it. Throws SystemError if the folder cannot be made or
    /// written to, or another run has claimed it (where the file system cannot tell: if it cannot be written
    /// to).
    FolderClaim(std::filesystem::path folder, const parallel::Team& team);
    FolderClaim(FolderClaim&& other) noexcept;
    FolderClaim(const FolderClaim&) = delete;
    FolderClaim& operator=(const FolderClaim&) = delete;
    FolderClaim& operator=(FolderClaim&&) = delete;
    ~FolderClaim();

    const std::filesystem::path& path() const { return folder_; }

    /// On the first process: throws SystemError if the folder has been removed or replaced.
    void require() const;

  private:
    void claim();
    bool is_there() const;

    std::filesystem::path folder_;
    int file_ = -1;      ///< the open folder, on the first process
    bool made_ = false;  ///< by this object, likewise
};

}  // namespace thermocontact::output

#include "laws/cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "error.h"

namespace thermocontact::laws {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const std::string& reason) {
    throw SystemError("the cache of compiled laws, " + folder.string() + ": " + reason +
                      "; XDG_CACHE_HOME names another place");
}

fs::path folder() {
    for (const auto& [variable, below] : {std::pair{"XDG_CACHE_HOME", ""}, std::pair{"HOME", ".cache"}}) {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): before any thread starts
        if (const char* value = std::getenv(variable); value != nullptr && *value == '/') {
            return fs::path(value) / below / "thermocontact";
        }
    }
    fail("~/.cache/thermocontact", "there is no home folder");
}

/// What others could have written is not loaded.
fs::path owned_folder() {
    const fs::path path = folder();
    std::error_code error;
    fs::create_directories(path, error);
    struct stat facts {};
    if (stat(path.c_str(), &facts) != 0 || !S_ISDIR(facts.st_mode)) {
        fail(path, "cannot be made" + (error ? ": " + error.message() : std::string()));
    }
    if (facts.st_uid != geteuid() || (facts.st_mode & S_IWOTH) != 0) {
        fail(path, "belongs to another user, or others may write to it");
    }
    return path;
}

/// Held by one process at a time, and by none that has ended.
class Lock {
  public:
    explicit Lock(const fs::path& cache)
        : file_(open((cache / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
        if (file_ < 0) {
            fail(cache, std::string("cannot be written to: ") + std::strerror(errno));
        }
        while (flock(file_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock() { close(file_); }

  private:
    int file_;
};

class Workshop {
  public:
    explicit Workshop(const fs::path& cache) : path_((cache / "making-XXXXXX").string()) {
        if (mkdtemp(path_.data()) == nullptr) {
            fail(cache, std::string("cannot be written to: ") + std::strerror(errno));
        }
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    ~Workshop() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    fs::path path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace

fs::path cached(const std::string& name, const std::function<fs::path(const fs::path& folder)>& make) {
    const fs::path cache = owned_folder(), file = cache / name;
    if (fs::exists(file)) {
        return file;
    }
    const Lock lock(cache);
    if (!fs::exists(file)) {
        const Workshop workshop(cache);
        const fs::path made = make(workshop.path());
        std::error_code error;
        fs::rename(made, file, error);
        if (error) {
            fail(cache, "cannot be written to: " + error.message());
        }
    }
    return file;
}

}  // namespace thermocontact::laws

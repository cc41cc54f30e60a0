#include "plan/writing.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>

#include "error.h"
#include "output/files.h"
#include "stopwatch.h"

namespace thermocontact::plan {
namespace {

constexpr double folder_besides = 3e-3;  ///< s, measured: of a run's folder, whatever it is written to
constexpr int trials = 5;
constexpr std::size_t bytes = 8192;  ///< of a small output

/// A folder that goes when this does.
class Scratch {
  public:
    explicit Scratch(const std::filesystem::path& beside) {
        std::error_code ignored;
        std::filesystem::path parent = std::filesystem::absolute(beside, ignored).parent_path();
        while (!parent.empty() && parent != parent.root_path() && !std::filesystem::exists(parent, ignored)) {
            parent = parent.parent_path();
        }
        std::string name = (parent / ".thermocontact-XXXXXX").string();
        if (::mkdtemp(name.data()) != nullptr) {
            path_ = name;
        }
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        if (path_) {
            std::filesystem::remove_all(*path_, ignored);
        }
    }

    const std::optional<std::filesystem::path>& path() const { return path_; }

  private:
    std::optional<std::filesystem::path> path_;
};

/// A checkpoint that reaches the disk, and a summary.
double folder_seconds(const std::filesystem::path& folder) {
    const Stopwatch stopwatch;
    output::make_folder(folder / "fields");
    output::write_whole(folder / "checkpoint", std::string(bytes, '0'), output::Sync::yes);
    output::write_whole(folder / "summary", std::string(bytes, '0'));
    return stopwatch.seconds();
}

/// The files of the body and of its contact, and their list, which is there already.
double files_seconds(const std::filesystem::path& folder) {
    const std::string content(bytes, '0');
    std::array<double, trials> seconds{};
    for (std::size_t trial = 0; trial < seconds.size(); ++trial) {
        const Stopwatch stopwatch;
        output::write_whole(folder / ("body" + std::to_string(trial)), content);
        output::write_whole(folder / ("contact" + std::to_string(trial)), content);
        output::write_whole(folder / "list", content);
        seconds[trial] = stopwatch.seconds();
    }
    std::ranges::sort(seconds);
    return seconds[trials / 2];
}

}  // namespace

Writing measured_writing(const std::filesystem::path& results) {
    const Scratch scratch(results);
    if (!scratch.path()) {
        return {};
    }
    try {
        return {folder_besides + folder_seconds(*scratch.path()), files_seconds(*scratch.path())};
    } catch (const SystemError&) {
        return {};
    }
}

}  // namespace thermocontact::plan

/// Where pilots are run and counted.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "parallel/backend.h"
#include "plan/pilot.h"
#include "plan/writing.h"
#include "stopwatch.h"

namespace thermocontact::plan {

/// A scene as the command line has it.
struct SceneSource {
    std::filesystem::path path;
    std::vector<std::string> overrides;
    std::filesystem::path results = {};  ///< folder that a run of it writes to; empty: none that is known
};

class Bench {
  public:
    /// `check` is called after every step of a pilot and may throw to end it. Throws SceneError.
    Bench(SceneSource source, Quantity quantity, const parallel::Backend* backend,
          std::function<void()> check);

    const scene::Scene& scene() const { return scene_; }

    /// Where results go.
    const Writing& writing() const { return writing_; }

    /// Whether the scene can be stepped so: its own keys may stand against it.
    bool can(const Stepping& stepping);

    /// Runs, or hands out again; nothing where the numerics failed, which failure() then tells. Pilots keep
    /// their addresses.
    const Pilot* run(const Discretisation& discretisation);

    /// Whether memory holds it.
    bool fits(const Discretisation& discretisation);

    /// Whether it was run already.
    bool has(const Discretisation& discretisation) const;

    /// All that succeeded.
    std::vector<const Pilot*> pilots() const;

    const std::string& failure() const { return failure_; }
    int runs() const { return static_cast<int>(pilots_.size()); }
    double seconds() const { return stopwatch_.seconds(); }

  private:
    const scene::Scene& template_for(const Stepping& stepping);

    SceneSource source_;
    Quantity quantity_;
    const parallel::Backend* backend_;
    std::function<void()> check_;
    scene::Scene scene_;
    Writing writing_;
    std::map<std::string, scene::Scene> templates_;  ///< by describe(stepping)
    std::map<std::string, std::optional<Pilot>> pilots_;
    std::string failure_;
    Stopwatch stopwatch_;
};

}  // namespace thermocontact::plan

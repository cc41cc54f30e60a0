/// The checkpoints of a run: when one is due, and the file in its results folder.
#pragma once

#include <filesystem>
#include <string>

#include "march/simulation.h"
#include "output/files.h"
#include "stopwatch.h"

namespace thermocontact::output {

class Checkpoints {
  public:
    /// `run`: see Checkpoint; only the first process's counts.
    Checkpoints(std::filesystem::path folder, const scene::Scene& scene, const march::Simulation& simulation,
                std::string run);

    /// The simulation is another one from now on.
    void follow(const march::Simulation& simulation) { simulation_ = &simulation; }

    /// Whether this process finds that it is time for one (output.checkpoint_every). The clocks of several
    /// processes differ: the first one's answer counts.
    bool due() const;

    /// Writes one of the current state unless there is one already. Every process must call. Throws
    /// SystemError.
    void write(Sync sync);

  private:
    std::filesystem::path folder_;
    const scene::Scene* scene_;
    const march::Simulation* simulation_;
    std::string run_;
    int last_step_ = -1;
    Stopwatch since_last_;
    double cost_ = 0;  ///< s, of the last one
};

}  // namespace thermocontact::output

/// The results folder of a run (INTERFACE.md). Of several processes each writes its pieces of the fields, the
/// first one all else; every function is called by all of them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "output/fields.h"

namespace thermocontact::output {

/// Seconds of the phases of a run. They add up to the total, which counts from the start of the process.
struct Seconds {
    double start = 0;  ///< before the scene is read: loading the program, MPI and PETSc
    double setup = 0, factor = 0, steps = 0, output = 0, total = 0;
};

class Results {
  public:
    /// Makes the folder and clears the results of an earlier run from it. Throws SystemError if it is not
    /// writable.
    Results(std::filesystem::path folder, const scene::Scene& scene, march::Simulation& simulation);

    /// Appends the step's row to history.csv and returns it; writes its fields when they are due. Throws
    /// SystemError.
    march::Record add_step();

    /// Writes the fields of the current state if add_step() did not: the last step, whatever `output.every`.
    void add_fields();

    /// Writes summary.json; `status` is "completed", "failed" or "interrupted", `reason` empty when
    /// completed.
    void finish(const std::string& status, const std::string& reason, const Seconds& seconds);

  private:
    bool first_process() const { return simulation_->team().rank() == 0; }
    void add_history(const march::Record& record);
    void write_grid(const std::string& name, const VtuGrid& grid);

    std::filesystem::path folder_;
    const scene::Scene* scene_;
    march::Simulation* simulation_;
    FieldGrids grids_;
    std::ofstream history_, steps_;
    std::vector<PvdEntry> entries_;
    int last_fields_ = -1;
};

/// summary.json of a run that ended before its first step, in place of the results of an earlier run.
void write_setup_failure(const std::filesystem::path& folder, const scene::Scene& scene,
                         const std::string& reason);

}  // namespace thermocontact::output

/// The results folder of a run (INTERFACE.md). Of several processes each writes its pieces of the fields, the
/// first one all else; every function is called by all of them.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/checkpoints.h"
#include "output/conditioning.h"
#include "output/fields.h"
#include "output/folder_claim.h"

namespace thermocontact::output {

/// Seconds of the phases of a run. They add up to the total, which counts from the start of the process.
struct Seconds {
    double start = 0;  ///< before the scene is read: loading the program, MPI and PETSc
    double setup = 0, factor = 0, steps = 0, output = 0, total = 0;
};

class Results {
  public:
    /// Clears the results of an earlier run from the folder. After a restart from `earlier`, which the
    /// simulation has gone on from already, results of the same run are kept up to its step and continued.
    /// Throws SystemError, here and below, also if the folder is no longer there.
    Results(FolderClaim claim, const scene::Scene& scene, march::Simulation& simulation,
            const Checkpoint* earlier = nullptr);

    /// The simulation is this one from now on, another one where the number of its mesh is another.
    void follow(march::Simulation& simulation, int mesh);

    /// Appends the step's row to history.csv and returns it; writes its fields when they are due. Throws
    /// SystemError.
    march::Record add_step();

    /// Writes the fields of the current state if add_step() did not: the last step, whatever `output.every`.
    void add_fields();

    /// Whether a checkpoint is due, as this process sees it: see Checkpoints.
    bool checkpoint_is_due() const { return checkpoints_.due(); }

    /// Writes one of the current state, if the last one is of an earlier.
    void add_checkpoint();

    /// Writes summary.json; `status` is "completed", "failed" or "interrupted", `reason` empty when
    /// completed; `plan`, unless null, is what the run was planned for.
    void finish(const std::string& status, const std::string& reason, const Seconds& seconds,
                const std::vector<BalanceCondition>& conditions, const nlohmann::ordered_json& plan = {});

  private:
    const std::filesystem::path& folder() const { return claim_.path(); }
    void told(const std::function<void()>& work) const;
    void if_first(const std::function<void()>& work) const;  ///< called by all, done by the first process
    void open_files(bool continues);
    void add_rows(const march::Record& record);
    void add_attempts();
    bool fields_are_due() const;
    void write_fields();
    void write_grid(const std::string& name, const VtuGrid& grid);

    FolderClaim claim_;
    const scene::Scene* scene_;
    march::Simulation* simulation_;
    std::unique_ptr<FieldGrids> grids_;
    int mesh_ = 0;
    Checkpoints checkpoints_;
    std::ofstream history_, steps_;
    bool has_header_ = false, steps_have_header_ = false;
    std::vector<PvdEntry> entries_;
    int last_fields_ = -1;
};

/// summary.json of a run that ended before its first step, in place of the results of an earlier run.
void write_setup_failure(const std::filesystem::path& folder, const scene::Scene& scene,
                         const std::string& reason);

}  // namespace thermocontact::output

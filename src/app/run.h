/// The commands of the program. Each returns its exit code (INTERFACE.md) and reports errors on stderr.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "app/command_line.h"
#include "march/simulation.h"
#include "output/results.h"
#include "parallel/backend.h"

namespace thermocontact::app {

/// Who follows a run that was planned.
struct RunWatch {
    std::function<void(march::Simulation&, const march::Record&)> step;  ///< after each, with its row
    /// After the last, for the summary's "plan".
    std::function<nlohmann::ordered_json(const output::Seconds&)> end;
};

/// `thermocontact run`: marches the scene and writes its results.
/// `backend`: null where the process is alone and needs no PETSc so far.
int run(const RunCommand& command, const parallel::Backend* backend, const RunWatch* watch = nullptr);

}  // namespace thermocontact::app

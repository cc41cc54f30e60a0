/// The commands of the program. Each returns its exit code (INTERFACE.md) and reports errors on stderr.
#pragma once

#include "app/command_line.h"
#include "parallel/backend.h"

namespace thermocontact::app {

/// `thermocontact run`: marches the scene and writes its results.
/// `backend`: null where the process is alone and needs no PETSc so far.
int run(const RunCommand& command, const parallel::Backend* backend);

}  // namespace thermocontact::app

/// `thermocontact run --accuracy` and `--budget`: a plan, the run that it chooses, and what became of it.
#pragma once

#include "app/command_line.h"
#include "parallel/backend.h"

namespace thermocontact::app {

/// Plans for command.request, runs, and says predicted and achieved error and time on stdout and in
/// summary.json
/// ("plan"). Nothing is run, with exit 3, where the request cannot be met.
int planned_run(const RunCommand& command, const parallel::Backend* backend);

}  // namespace thermocontact::app

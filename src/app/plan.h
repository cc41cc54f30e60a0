/// `thermocontact plan`: which discretisation gives the accuracy, or the most accuracy in the time, asked
/// for.
#pragma once

#include "app/command_line.h"
#include "parallel/backend.h"

namespace thermocontact::app {

/// Runs pilots and prints the plan; exit 3 where the request cannot be met. Throws SceneError, NumericsError.
int plan(const PlanCommand& command, const parallel::Backend* backend);

}  // namespace thermocontact::app

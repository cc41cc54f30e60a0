/// The commands of the program. Each returns its exit code (INTERFACE.md) and reports errors on stderr.
#pragma once

#include "app/command_line.h"

namespace thermocontact::app {

/// `thermocontact run`: marches the scene and writes its results.
int run(const RunCommand& command);

}  // namespace thermocontact::app

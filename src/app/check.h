/// `thermocontact check`: the physics a scene describes and the theory's hypotheses on its data.
#pragma once

#include "app/command_line.h"

namespace thermocontact::app {

/// Reads and validates the scene and prints what it found. Throws SceneError.
int check(const CheckCommand& command);

}  // namespace thermocontact::app

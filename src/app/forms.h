/// The command `forms`: the laws that a scene may replace by files of its own.
#pragma once

#include "app/command_line.h"

namespace thermocontact::app {

/// Prints the built-in laws with what they take and their keys, or the file of one.
int forms(const FormsCommand& command);

}  // namespace thermocontact::app

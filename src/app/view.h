/// `thermocontact view`: a run's results as a page, shown in the browser.
#pragma once

#include "app/command_line.h"

namespace thermocontact::app {

/// Writes the page and, unless told not to, opens it where there is a screen. Throws SceneError, SystemError.
int view(const ViewCommand& command);

}  // namespace thermocontact::app

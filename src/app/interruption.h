/// SIGINT and SIGTERM, which end a run at the next step with its results and a checkpoint.
#pragma once

namespace thermocontact::app {

/// From now on both are noted. One that comes seconds after the first ends the process at once, for those who
/// do not want to wait for the step: the results so far stand as after a kill.
void catch_interruptions();

/// The signal that came first, 0: none.
int caught_signal();

/// What work that writes no results is ended by.
struct Interrupted {
    int signal;
};

/// Throws Interrupted once a signal came.
void throw_if_interrupted();

}  // namespace thermocontact::app

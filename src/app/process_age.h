/// How long the process has run before it measures by itself.
#pragma once

namespace thermocontact::app {

/// Seconds since the system started this process: loading its libraries, starting MPI and PETSc, and what ran
/// before `thermocontact` handed over to `thermocontact-petsc`. The system counts in hundredths of a second.
/// 0 where it does not tell.
double process_age();

}  // namespace thermocontact::app

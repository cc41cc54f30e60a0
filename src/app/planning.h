/// What `plan` and planned runs have in common: pilots that a signal ends, and that may need PETSc.
#pragma once

#include <functional>
#include <string>

#include "parallel/backend.h"
#include "plan/bench.h"

namespace thermocontact::app {

/// Calls `work` with a bench for the pilots of `scene`; the exit code. A signal ends it with `interrupted` on
/// stderr. Throws SceneError, NumericsError.
int with_bench(const plan::SceneSource& scene, plan::Quantity of, const parallel::Backend* backend,
               const std::string& interrupted, const std::function<int(plan::Bench&)>& work);

}  // namespace thermocontact::app

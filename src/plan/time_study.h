/// What ways to step err by, each refined alone on one mesh.
#pragma once

#include "plan/study.h"

namespace thermocontact::plan {

/// Adds a model of each stepping that the scene allows and that resolves its motions; says which do not.
/// Throws NumericsError where no pilot could be run.
void study_time(Study& study);

}  // namespace thermocontact::plan

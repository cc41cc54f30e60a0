/// What meshes err by, each kind refined alone with one way to step.
#pragma once

#include "plan/study.h"

namespace thermocontact::plan {

/// Adds models of the scene's own cells of degree 1 and 2, and of the best grading of degree 2
/// (grading_search.h) where a search for it is worth its time; of a mesh file its only one. The times must be
/// there. Throws NumericsError where no pilot could be run.
void study_space(Study& study);

}  // namespace thermocontact::plan

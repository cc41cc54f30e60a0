/// Meshes with fewer cells along the axes that matter less.
#pragma once

#include <vector>

#include "plan/study.h"

namespace thermocontact::plan {

/// Adds a kind of mesh that is stretched (Discretisation), from a ladder of pilots of one kind whose model is
/// there: its finest one is run again with half the cells along one axis alone, and that is kept, and gone on
/// from, as long as it is a bargain: the error grows by less than a quarter as fast (as a power) as on meshes
/// of as few cells with the proportions that they had. What it differs by is one more source of error. As the
/// ladder's errors fall, those of the stretched kind do. Takes at most `seconds`. The pilot that was kept
/// last.
const Pilot& learn_proportions(Study& study, const std::vector<const Pilot*>& pilots, double seconds);

}  // namespace thermocontact::plan

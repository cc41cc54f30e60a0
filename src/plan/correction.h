/// Models made true where they are used: pilots near a choice correct what ladders far from it foresee.
#pragma once

#include "plan/study.h"

namespace thermocontact::plan {

/// Compares the models of the option's mesh and stepping with three pilots: one, and one coarser than that in
/// space alone, and in time alone; corrects the models' errors by the ratios of the differences found to
/// those foreseen, and learns the costs. The pilots are as fine as `seconds` allow: twice as fine as the
/// option, as fine, or half so. False where these would take longer, too.
bool correct_near(Study& study, const Option& option, double seconds);

/// s that a run of the option takes without its output.
double seconds_without_output(Models models, const Discretisation& choice);

}  // namespace thermocontact::plan

/// Models made true where they are used: ladders of pilots around a choice take the place of those far from
/// it.
#pragma once

#include "plan/study.h"

namespace thermocontact::plan {

/// Two ladders of pilots: of meshes of the option's kind, in few steps, and of its steppings, on a
/// coarse mesh. What pilots far from a choice foresee of it is an extrapolation, and of many candidates the
/// one whose extrapolation is the most hopeful is chosen: where a coarse mesh sees theory's order, a finer
/// one may meet a corner or an end of contact that has less. The errors of the option's mesh and stepping are
/// then those that the ladders show, and the costs are learnt. A ladder ends at twice the option's cells
/// (steps), or at as many, as `seconds` allow: one that ends before tells less than the run itself will.
/// False where nothing is left to run in that time.
bool learn_near(Study& study, const Option& option, double seconds);

/// Whether the models of its mesh and of its stepping are of ladders that reach it, or nearly so.
bool is_near(const Models& models, const Discretisation& choice);

/// Only the meshes and steppings that such ladders were of; all where there are none.
Models near_only(Models models);

}  // namespace thermocontact::plan

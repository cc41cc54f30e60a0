/// Models of error and time from pilots.
#pragma once

#include <vector>

#include "plan/choice.h"
#include "plan/climb.h"

namespace thermocontact::plan {

/// How many steps and factorisations a stepping takes, and what it errs by.
TimeModel time_model(const Stepping& stepping, const Climbed& climbed);

/// How many axes have more than one cell, and are refined; of the mesh of a file, its dimension.
int refined_axes(const scene::Scene& scene);

/// What meshes of one kind err by and cost, from pilots of several scales; `axes` of them are refined.
SpaceModel space_model(int axes, const std::vector<const Pilot*>& pilots, ErrorCurve error);

/// Takes the costs of the model of their kind of mesh from these pilots instead: at each scale the smallest,
/// as what else a machine does only adds to them.
void learn_costs(Models& models, const std::vector<const Pilot*>& pilots, int axes);

}  // namespace thermocontact::plan

/// The orders that theory gives errors of smooth solutions: observed ones are taken no higher.
#pragma once

#include <string>
#include <vector>

#include "plan/discretisation.h"

namespace thermocontact::plan {

/// [components], of the error in h.
std::vector<double> highest_in_space(const std::vector<std::string>& components, int degree);

/// [components], of the error in k, or in the tolerance: that is one step's, which errs as k^(order + 1).
std::vector<double> highest_in_time(const std::vector<std::string>& components, const Stepping& stepping);

}  // namespace thermocontact::plan

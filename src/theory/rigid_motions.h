/// What is left of a body's freedom by prescribed displacements.
#pragma once

#include <vector>

#include "fem/space.h"

namespace thermocontact::theory {

/// Whether no translation or rotation of the body vanishes at all fixed dofs [nodes][dimension].
bool held_rigidly(const fem::Space& space, const std::vector<char>& fixed, int dimension);

}  // namespace thermocontact::theory

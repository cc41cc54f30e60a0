/// What is left of a body's freedom by prescribed displacements.
#pragma once

#include <vector>

#include "model/springs.h"

namespace thermocontact::theory {

/// Whether no translation or rotation of the body vanishes at all fixed dofs [nodes][dimension] and leaves
/// the springs (null: none) without force.
bool held_rigidly(const fem::Space& space, const std::vector<char>& fixed, int dimension,
                  const model::Springs* springs = nullptr);

}  // namespace thermocontact::theory

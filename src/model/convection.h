/// Heat that boundaries exchange with their surroundings, h (theta - theta_a) per area.
#pragma once

#include <optional>
#include <vector>

#include "fem/block_matrix.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// The matrix of h theta, [nodes][nodes]; none where no boundary has it. What flows in at theta = 0, the load
/// of h theta_a, is Loads::ambient.
std::optional<fem::BlockMatrix> convection_matrix(const scene::Scene& scene, const mesh::Mesh& mesh,
                                                  const fem::Space& space, const fem::NodeGraph& graph);

/// [nodes]: 1 on boundaries with h > 0, which hold the temperature.
std::vector<char> convection_nodes(const scene::Scene& scene, const mesh::Mesh& mesh,
                                   const fem::Space& space);

}  // namespace thermocontact::model

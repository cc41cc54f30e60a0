/// The body cut into pieces of one material each.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// Cells by the region whose own laws they have; "": those that have the scene's defaults. No piece is empty.
std::map<std::string, std::vector<std::int32_t>> cells_by_laws(const scene::Scene& scene,
                                                               const mesh::Mesh& mesh);

}  // namespace thermocontact::model

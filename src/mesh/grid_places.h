/// Where nodes lie on the grid of a rectangle or a box.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace thermocontact::mesh {

/// Along each axis 2 i on the i-th plane of grid points across it, 2 i + 1 between that and the next one.
using GridPlace = std::array<std::int32_t, 3>;

/// The places of `nodes` (m), points of a mesh with that many vertices. No cell reaches across a plane. None
/// where the mesh is not the shape that the scene names: a file's, or one that was refined.
std::vector<GridPlace> grid_places(const scene::MeshSpec& spec, std::size_t vertices,
                                   std::span<const Point> nodes);

}  // namespace thermocontact::mesh

/// Meshes of the shapes that a scene can name.
#pragma once

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace thermocontact::mesh {

/// The mesh that a scene asks for.
Mesh make_mesh(const scene::MeshSpec& spec);

/// The rectangle [lower, upper] in cells[0] x cells[1] quadrilaterals, or each of these cut along its right
/// (lower left to upper right), left or both diagonals; boundaries bottom, left, right, top.
Mesh make_rectangle(const scene::MeshSpec& spec);

/// The box [lower, upper] in cells[0] x cells[1] x cells[2] hexahedra, or each of these cut into the six
/// tetrahedra around its diagonal; boundaries back (upper z), bottom, front (lower z), left, right, top.
Mesh make_box(const scene::MeshSpec& spec);

}  // namespace thermocontact::mesh

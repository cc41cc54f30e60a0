/// Meshes from Gmsh's files.
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace thermocontact::mesh {

/// The mesh of a Gmsh file (.msh, versions 2 and 4): first-order cells of one kind and of the highest
/// dimension there is. Named physical groups of that dimension are its regions, those of one dimension less
/// its boundaries; facets in none are free. Throws SceneError "PATH: ..." or "PATH:LINE: ..." naming the
/// entity where the file cannot be used, SystemError without Gmsh's library.
Mesh read_gmsh(const std::filesystem::path& path);

}  // namespace thermocontact::mesh

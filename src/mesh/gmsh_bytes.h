/// What Gmsh read, as bytes from one process to another of the same program.
#pragma once

#include <string>

#include "mesh/gmsh_library.h"

namespace thermocontact::mesh {

std::string to_bytes(const GmshContents& contents);

/// Of bytes that to_bytes() made, whole.
GmshContents from_bytes(const std::string& bytes);

}  // namespace thermocontact::mesh

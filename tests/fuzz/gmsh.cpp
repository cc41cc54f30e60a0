/// Gmsh's files: any bytes as a mesh.
#include "fuzz/input.h"
#include "mesh/gmsh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace thermocontact;
    fuzz::answers([&] { mesh::read_gmsh(fuzz::as_file(fuzz::as_text(data, size), "mesh.msh")); });
    return 0;
}

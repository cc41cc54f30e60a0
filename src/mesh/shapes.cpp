#include "mesh/shapes.h"

namespace thermocontact::mesh {

Mesh make_mesh(const scene::MeshSpec& spec) {
    if (spec.file) {
        return *spec.file;
    }
    return spec.shape == "box" ? make_box(spec) : make_rectangle(spec);
}

}  // namespace thermocontact::mesh

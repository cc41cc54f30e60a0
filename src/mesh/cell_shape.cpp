#include "mesh/cell_shape.h"

#include <array>
#include <stdexcept>

namespace thermocontact::mesh {

const CellShape& cell_shape(const std::string& name) {
    static const std::array<CellShape, 4> shapes{
        CellShape{"triangle", 2, 3, {{1, 2}, {0, 2}, {0, 1}}},
        CellShape{"quadrilateral", 2, 4, {{0, 1}, {0, 2}, {1, 3}, {2, 3}}},
        CellShape{"tetrahedron", 3, 4, {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}},
        CellShape{"hexahedron",
                  3,
                  8,
                  {{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 2, 4, 6}, {1, 3, 5, 7}, {2, 3, 6, 7}, {4, 5, 6, 7}}}};
    for (const CellShape& shape : shapes) {
        if (shape.name == name) {
            return shape;
        }
    }
    throw std::logic_error("no cells of kind " + name);
}

}  // namespace thermocontact::mesh

/// The kinds of cells, in the numbering of Basix.
#pragma once

#include <string>
#include <vector>

namespace thermocontact::mesh {

struct CellShape {
    std::string name;
    int dimension;
    int vertices;
    std::vector<std::vector<int>> facets;  ///< [facet]: its vertices
};

/// "triangle", "quadrilateral", "tetrahedron" or "hexahedron". Throws std::logic_error for another name.
const CellShape& cell_shape(const std::string& name);

}  // namespace thermocontact::mesh

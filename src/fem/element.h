/// What assembly needs of the Lagrange element, taken from Basix.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace thermocontact::fem {

struct LagrangeElement {
    int degree;
    int node_count;  ///< nodes of a cell
    std::vector<std::vector<double>>
        vertex_weights;  ///< [node][vertex]: shape functions of the geometry at each node
    std::vector<std::vector<std::vector<int>>> entities;  ///< [dimension][entity]: nodes inside it
    std::vector<std::vector<std::vector<int>>> topology;  ///< [dimension][entity]: its vertices
    std::vector<std::vector<int>> facet_nodes;            ///< [facet]: vertices of the facet, then the others
};

/// The Lagrange element of the cell ("triangle", "quadrilateral", "tetrahedron", "hexahedron") and degree (1,
/// 2), nodes in Basix order.
LagrangeElement make_lagrange(const std::string& cell, int degree);

}  // namespace thermocontact::fem

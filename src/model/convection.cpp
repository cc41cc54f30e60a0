#include "model/convection.h"

#include <algorithm>

#include "model/loads.h"
#include "model/physics.h"

namespace thermocontact::model {

std::optional<fem::BlockMatrix> convection_matrix(const scene::Scene& scene, const mesh::Mesh& mesh,
                                                  const fem::Space& space, const fem::NodeGraph& graph) {
    if (!has_convection(scene)) {
        return std::nullopt;
    }
    fem::BlockMatrix matrix = fem::zero_matrix(graph, 1, 1);
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.convection) {
            fem::Form form(fem::find_kernel("convection.exchange", mesh.cell, space.element.degree), mesh,
                           {{"h", {boundary.convection->coefficient}}});
            fem::assemble_facets(form, facets_of(mesh, name), space, matrix);
        }
    }
    return matrix;
}

std::vector<char> convection_nodes(const scene::Scene& scene, const mesh::Mesh& mesh,
                                   const fem::Space& space) {
    std::vector<char> marked(space.nodes.size(), 0);
    for (const auto& [name, boundary] : scene.boundaries) {
        if (!boundary.convection || boundary.convection->coefficient == 0) {
            continue;
        }
        // by the name: this part of the mesh may have no facet there
        const auto index = std::ranges::find(mesh.boundary_names, name) - mesh.boundary_names.begin();
        for (const std::int32_t node : space.boundary_nodes[static_cast<std::size_t>(index)]) {
            marked[static_cast<std::size_t>(node)] = 1;
        }
    }
    return marked;
}

}  // namespace thermocontact::model

#include "model/contact_surface.h"

#include <algorithm>

#include "model/loads.h"
#include "model/nodal.h"

namespace thermocontact::model {
namespace {

void interpolate_fields(ContactSurface& surface, const fem::Space& space, double t) {
    interpolate_at(space, {&surface.laws.gap, 1}, surface.nodes, t, surface.gap);
    if (surface.laws.conductance) {
        interpolate_at(space, {&surface.laws.conductance->foundation_temperature, 1}, surface.nodes, t,
                       surface.foundation_temperature);
    }
}

bool depends_on_time(const scene::Contact& laws) {
    return laws.gap.depends_on_time() ||
           (laws.conductance && laws.conductance->foundation_temperature.depends_on_time());
}

/// On intervals and quadrilaterals m Gauss points a direction are exact to degree 2 m - 1: the rule of an
/// even degree is that of the next odd one. On the triangles around a tetrahedron each degree has its own.
int gauss_rule(int degree, const mesh::Mesh& mesh) {
    return degree == 0 || mesh.cell == "tetrahedron" ? degree : degree | 1;
}

}  // namespace

ContactSurfaces make_contact_surfaces(const scene::Scene& scene, const mesh::Mesh& mesh,
                                      const fem::Space& space) {
    ContactSurfaces surfaces;
    for (const auto& [name, boundary] : scene.boundaries) {
        if (!boundary.contact) {
            continue;
        }
        auto surface =
            std::make_unique<ContactSurface>(ContactSurface{name,
                                                            *boundary.contact,
                                                            gauss_rule(boundary.contact->quadrature, mesh),
                                                            facets_of(mesh, name),
                                                            {},
                                                            {},
                                                            {}});
        // by the name: this part of the mesh may have no facet there
        const auto index = std::ranges::find(mesh.boundary_names, name) - mesh.boundary_names.begin();
        surface->nodes = space.boundary_nodes[static_cast<std::size_t>(index)];
        surface->gap.resize(space.nodes.size());
        if (surface->laws.conductance) {
            surface->foundation_temperature.resize(space.nodes.size());
        }
        interpolate_fields(*surface, space, 0.0);
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

void update(ContactSurfaces& surfaces, const fem::Space& space, double t) {
    for (const auto& surface : surfaces) {
        if (depends_on_time(surface->laws)) {
            interpolate_fields(*surface, space, t);
        }
    }
}

}  // namespace thermocontact::model

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
    interpolate_at(space, surface.laws.foundation_velocity, surface.nodes, t, surface.foundation_velocity);
}

bool depends_on_time(const scene::Contact& laws) {
    return laws.gap.depends_on_time() || model::depends_on_time(laws.foundation_velocity) ||
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
        if (const auto& friction = boundary.contact->friction; friction && friction->regularisation == 0) {
            surface->multiplier = std::make_unique<FrictionMultiplier>(mesh, surface->facets, surface->rule,
                                                                       space.element.degree, scene.dimension);
        }
        // by the name: this part of the mesh may have no facet there
        const auto index = std::ranges::find(mesh.boundary_names, name) - mesh.boundary_names.begin();
        surface->nodes = space.boundary_nodes[static_cast<std::size_t>(index)];
        surface->gap.resize(space.nodes.size());
        if (surface->laws.conductance) {
            surface->foundation_temperature.resize(space.nodes.size());
        }
        const std::size_t nodes = surface->laws.foundation_velocity.empty()
                                      ? static_cast<std::size_t>(space.dofmap.nodes_per_cell)
                                      : space.nodes.size();
        surface->foundation_velocity.resize(nodes * static_cast<std::size_t>(scene.dimension));
        interpolate_fields(*surface, space, 0.0);
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

/// Numbers that a multiplier takes on a facet; by the mesh alone where this part has no facet of the surface.
std::size_t numbers_on_facet(const ContactSurface& surface, const mesh::Mesh& mesh) {
    if (!surface.facets.empty()) {
        return surface.multiplier->values().size() / surface.facets.size();
    }
    return fem::make_lagrange(mesh.cell, 2).facet_nodes.front().size() *
           static_cast<std::size_t>(mesh.dimension);
}

/// The surface's facets are consecutive in the mesh, as these are sorted by boundary.
template <typename Visit>
void visit_multipliers(const ContactSurfaces& surfaces, const mesh::Mesh& mesh, Visit&& visit) {
    for (const auto& surface : surfaces) {
        if (surface->multiplier) {
            const auto first = std::ranges::find_if(mesh.facets, [&](const mesh::Facet& facet) {
                return !surface->facets.empty() && facet.boundary == surface->facets.front().boundary;
            });
            const std::size_t row = numbers_on_facet(*surface, mesh);
            visit(surface->multiplier->values(), row,
                  static_cast<std::size_t>(first - mesh.facets.begin()) * row);
        }
    }
}

std::vector<double> multipliers_of(const ContactSurfaces& surfaces, const mesh::Mesh& mesh) {
    std::vector<double> all;
    visit_multipliers(surfaces, mesh,
                      [&](const std::vector<double>& values, std::size_t row, std::size_t first) {
                          all.resize(mesh.facets.size() * row);
                          std::ranges::copy(values, all.begin() + static_cast<std::ptrdiff_t>(first));
                      });
    return all;
}

void set_multipliers(const ContactSurfaces& surfaces, const mesh::Mesh& mesh,
                     const std::vector<double>& all) {
    visit_multipliers(surfaces, mesh, [&](std::vector<double>& values, std::size_t, std::size_t first) {
        if (all.empty()) {
            std::ranges::fill(values, 0.0);
        } else {
            std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), values.size(), values.begin());
        }
    });
}

void update(ContactSurfaces& surfaces, const fem::Space& space, double t) {
    for (const auto& surface : surfaces) {
        if (depends_on_time(surface->laws)) {
            interpolate_fields(*surface, space, t);
        }
    }
}

}  // namespace thermocontact::model

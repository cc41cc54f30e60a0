/// The boundaries in contact: their facets, laws and prescribed fields.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem/space.h"
#include "model/friction_multiplier.h"
#include "scene/scene.h"

namespace thermocontact::model {

struct ContactSurface {
    std::string name;
    scene::Contact laws;
    int rule;  ///< of the contact forms: odd degree of a Gauss rule, or 0 for the rule at the nodes
               ///< (forms/space.py)
    std::vector<mesh::Facet> facets;
    std::vector<std::int32_t> nodes;
    std::vector<double> gap;                     ///< g at the nodes of the space, m (zero off the surface)
    std::vector<double> foundation_temperature;  ///< theta_F likewise, K; empty without conductance
    std::vector<double> foundation_velocity =
        {};  ///< v_F likewise [nodes][d], m/s; at rest: zeros of one cell
    std::unique_ptr<FrictionMultiplier> multiplier =
        nullptr;  ///< of the step at hand; where friction is exact

    /// v_F as a coefficient of the contact forms.
    fem::Field velocity_of_foundation(const fem::Space& space, int dimension) const {
        return {&foundation_velocity, dimension, laws.foundation_velocity.empty() ? nullptr : &space.dofmap};
    }
};

/// The surfaces in order of their names. Their fields keep their addresses: forms refer to them.
using ContactSurfaces = std::vector<std::unique_ptr<ContactSurface>>;

/// All contact boundaries of the scene, fields at t = 0.
ContactSurfaces make_contact_surfaces(const scene::Scene& scene, const mesh::Mesh& mesh,
                                      const fem::Space& space);

/// Fields that depend on time, at time t (s).
void update(ContactSurfaces& surfaces, const fem::Space& space, double t);

/// The multipliers of all surfaces, [facets of the mesh][numbers]: zero on other facets, empty where friction
/// is exact nowhere.
std::vector<double> multipliers_of(const ContactSurfaces& surfaces, const mesh::Mesh& mesh);

/// The reverse; from an empty vector, zero.
void set_multipliers(const ContactSurfaces& surfaces, const mesh::Mesh& mesh,
                     const std::vector<double>& values);

/// [nodes]: 1 on surfaces whose law (a member of scene::Contact) is present.
template <typename Law>
std::vector<char> nodes_with(const ContactSurfaces& surfaces, const fem::Space& space,
                             std::optional<Law> scene::Contact::*law) {
    std::vector<char> marked(space.nodes.size(), 0);
    for (const auto& surface : surfaces) {
        for (const std::int32_t node : surface->nodes) {
            if (surface->laws.*law) {
                marked[static_cast<std::size_t>(node)] = 1;
            }
        }
    }
    return marked;
}

}  // namespace thermocontact::model

/// What a scene switched on, and the numbers of its laws under the names that the forms use.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fem/form.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// Names of the physics present, in the order of the forms: "inertia", "elasticity", ..., "conductance".
std::vector<std::string> physics_of(const scene::Scene& scene);

/// Constants of the forms of the body; those of absent laws are zero, for the forms that sum several
/// (stress). Of law files, the parameters.
fem::Constants body_constants(const scene::Scene& scene);

/// The same for each region of the mesh, and last for cells in no region.
std::vector<fem::Constants> body_constants(const scene::Scene& scene, const mesh::Mesh& mesh);

/// The density, where it is the same everywhere.
std::optional<double> uniform_density(const scene::Scene& scene);

/// The heat capacity likewise.
std::optional<double> uniform_capacity(const scene::Scene& scene);

/// Constants of the contact forms of one boundary, `step` being k in u = u_old + k w.
fem::Constants contact_constants(const scene::Contact& contact, double step);

bool has_compliance(const scene::Scene& scene);
bool has_friction(const scene::Scene& scene);
bool has_conductance(const scene::Scene& scene);
bool has_convection(const scene::Scene& scene);
bool has_spring(const scene::Scene& scene);
bool has_friction_heat(const scene::Scene& scene);

}  // namespace thermocontact::model

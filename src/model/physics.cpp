#include "model/physics.h"

#include <algorithm>

namespace thermocontact::model {
namespace {

template <typename Predicate>
bool any_contact(const scene::Scene& scene, Predicate predicate) {
    return std::ranges::any_of(scene.boundaries, [&](const auto& entry) {
        return entry.second.contact && predicate(*entry.second.contact);
    });
}

template <typename Predicate>
bool any_boundary(const scene::Scene& scene, Predicate predicate) {
    return std::ranges::any_of(scene.boundaries, [&](const auto& entry) { return predicate(entry.second); });
}

}  // namespace

bool has_compliance(const scene::Scene& scene) {
    return any_contact(scene, [](const scene::Contact& contact) { return contact.compliance.has_value(); });
}

bool has_friction(const scene::Scene& scene) {
    return any_contact(scene, [](const scene::Contact& contact) { return contact.friction.has_value(); });
}

bool has_conductance(const scene::Scene& scene) {
    return any_contact(scene, [](const scene::Contact& contact) { return contact.conductance.has_value(); });
}

bool has_convection(const scene::Scene& scene) {
    return any_boundary(scene, [](const scene::Boundary& b) { return b.convection.has_value(); });
}

bool has_spring(const scene::Scene& scene) {
    return any_boundary(scene, [](const scene::Boundary& b) { return b.spring.has_value(); });
}

bool has_friction_heat(const scene::Scene& scene) {
    return any_contact(scene, [](const scene::Contact& contact) {
        return contact.friction && contact.friction->heat_share > 0;
    });
}

std::vector<std::string> physics_of(const scene::Scene& scene) {
    std::vector<std::string> names;
    const auto add = [&](bool present, const char* name) {
        if (present) {
            names.emplace_back(name);
        }
    };
    const auto& material = scene.material;
    const auto& heat = scene.heat;
    add(material && material->density, "inertia");
    add(material && material->elasticity, "elasticity");
    add(material && material->viscosity, "viscosity");
    add(heat && heat->thermal_stress, "thermal_stress");
    add(!scene.body_force.empty() || scene.own_body_force, "body_force");
    add(any_boundary(scene, [](const scene::Boundary& b) { return !b.traction.empty(); }), "traction");
    add(has_spring(scene), "spring");
    add(has_compliance(scene), "compliance");
    add(has_friction(scene), "friction");
    add(any_contact(scene, [](const scene::Contact& c) { return !c.foundation_velocity.empty(); }),
        "moving_foundation");
    add(heat && heat->capacity, "heat_capacity");
    add(heat && heat->conductivity, "conduction");
    add(heat && heat->strain_heating, "strain_heating");
    add(heat && heat->strain_rate_heating, "strain_rate_heating");
    add(heat && (heat->source || heat->own_source), "heat_source");
    add(any_boundary(scene, [](const scene::Boundary& b) { return b.heat_flux.has_value(); }), "heat_flux");
    add(has_convection(scene), "convection");
    add(has_conductance(scene), "conductance");
    add(has_friction_heat(scene), "friction_heat");
    return names;
}

namespace {

fem::Constants constants_of(const std::optional<scene::Material>& the_material,
                            const std::optional<scene::Heat>& the_heat, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    const std::size_t voigt = d * (d + 1) / 2;
    fem::Constants constants;
    const auto take = [&](const scene::Law& law) {
        for (const auto& [name, value] : law.constants) {
            constants[name] = {value};
        }
    };
    const auto tensor4 = [&](const std::string& name, const std::optional<scene::VoigtTensor>& tensor) {
        if (tensor && tensor->own) {
            take(*tensor->own);
            return;
        }
        constants[name] = tensor ? tensor->matrix : std::vector<double>(voigt * voigt, 0.0);
        constants[name + "_zz"] = tensor ? tensor->out_of_plane : std::vector<double>(voigt, 0.0);
    };
    const auto tensor2 = [&](const std::string& name, const std::optional<scene::SymmetricTensor>& tensor) {
        constants[name] = tensor ? tensor->matrix : std::vector<double>(d * d, 0.0);
        constants[name + "_zz"] = {tensor ? tensor->out_of_plane : 0.0};
    };
    const scene::Material material = the_material.value_or(scene::Material{});
    const scene::Heat heat = the_heat.value_or(scene::Heat{});
    constants["rho"] = {material.density.value_or(0.0)};
    constants["c"] = {heat.capacity.value_or(0.0)};
    tensor4("E", material.elasticity);
    tensor4("Visc", material.viscosity);
    tensor2("K", heat.conductivity);
    tensor2("M", heat.thermal_stress);
    tensor2("R", heat.strain_heating);
    tensor2("R_rate", heat.strain_rate_heating);
    if (heat.own_source) {
        take(*heat.own_source);
    }
    return constants;
}

/// `value` of the defaults, unless `of_region` says otherwise for some region.
template <typename OfRegion>
std::optional<double> uniform(const scene::Scene& scene, std::optional<double> value, OfRegion of_region) {
    const bool differs = std::ranges::any_of(
        scene.regions, [&](const auto& entry) { return of_region(entry.second) != value; });
    return differs ? std::nullopt : value;
}

}  // namespace

fem::Constants body_constants(const scene::Scene& scene) {
    return constants_of(scene.material, scene.heat, scene.dimension);
}

std::vector<fem::Constants> body_constants(const scene::Scene& scene, const mesh::Mesh& mesh) {
    std::vector<fem::Constants> constants;
    for (const std::string& name : mesh.region_names) {
        const auto region = scene.regions.find(name);
        constants.push_back(
            region == scene.regions.end()
                ? body_constants(scene)
                : constants_of(region->second.material, region->second.heat, scene.dimension));
    }
    constants.push_back(body_constants(scene));
    return constants;
}

std::optional<double> uniform_density(const scene::Scene& scene) {
    return uniform(scene, scene.material ? scene.material->density : std::nullopt,
                   [](const scene::Region& region) { return region.material->density; });
}

std::optional<double> uniform_capacity(const scene::Scene& scene) {
    return uniform(scene, scene.heat ? scene.heat->capacity : std::nullopt,
                   [](const scene::Region& region) { return region.heat->capacity; });
}

fem::Constants contact_constants(const scene::Contact& contact, double step) {
    // without friction nothing sticks: every slip velocity is above this epsilon
    fem::Constants constants{{"k", {step}}, {"eps", {-1.0}}, {"gamma", {1.0}}};
    const auto take = [&](const scene::Law& law) {
        for (const auto& [name, value] : law.constants) {
            constants[name] = {value};
        }
    };
    if (contact.compliance) {
        take(*contact.compliance);
    }
    if (contact.friction) {
        take(contact.friction->law);
        constants["eps"] = {contact.friction->regularisation};
        constants["heat_share"] = {contact.friction->heat_share};
    }
    if (contact.conductance) {
        take(contact.conductance->law);
    }
    return constants;
}

}  // namespace thermocontact::model

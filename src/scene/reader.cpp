#include "scene/reader.h"

#include <optional>

#include "scene/document.h"
#include "scene/schema.h"
#include "scene/settings.h"
#include "scene/tensors.h"
#include "scene/time_steps.h"

namespace thermocontact::scene {

namespace {

using nlohmann::json;

double number(const Settings& s, const std::string& name) {
    return s.value(name).get<double>();
}
int integer(const Settings& s, const std::string& name) {
    return s.value(name).get<int>();
}
std::string text(const Settings& s, const std::string& name) {
    return s.value(name).get<std::string>();
}

std::optional<double> optional_number(const Settings& s, const std::string& name) {
    return s.has(name) ? std::optional(number(s, name)) : std::nullopt;
}

Expression to_expression(const json& value) {
    return value.is_string() ? Expression(value.get<std::string>(), dimension)
                             : Expression(value.get<double>());
}

std::optional<Expression> optional_expression(const Settings& s, const std::string& name) {
    return s.has(name) ? std::optional(to_expression(s.value(name))) : std::nullopt;
}

/// Empty when the key is absent.
std::vector<Expression> expressions(const Settings& s, const std::string& name) {
    std::vector<Expression> list;
    if (s.has(name)) {
        for (const auto& item : s.value(name)) {
            list.push_back(to_expression(item));
        }
    }
    return list;
}

std::vector<std::optional<Expression>> free_expressions(const Settings& s, const std::string& name) {
    std::vector<std::optional<Expression>> list;
    if (s.has(name)) {
        for (const auto& item : s.value(name)) {
            list.push_back(item == "free" ? std::nullopt : std::optional(to_expression(item)));
        }
    }
    return list;
}

std::vector<double> flat(const json& rows) {
    std::vector<double> values;
    for (const auto& row : rows) {
        for (const auto& item : row) {
            values.push_back(item.get<double>());
        }
    }
    return values;
}

/// An isotropic body in plane strain, the only one whose stresses along z are known and not zero.
bool is_isotropic_plane_strain(const Settings& s) {
    return s.has("material.elasticity.plane") && text(s, "material.elasticity.plane") == "strain";
}

std::optional<SymmetricTensor> symmetric_tensor(const Settings& s, const std::string& name) {
    if (!s.has(name)) {
        return std::nullopt;
    }
    const json& value = s.value(name);
    return SymmetricTensor{value.is_number() ? scaled_identity(value.get<double>(), dimension) : flat(value)};
}

MeshSpec read_mesh(const Settings& s) {
    return {text(s, "mesh.shape"), s.value("mesh.lower").get<std::vector<double>>(),
            s.value("mesh.upper").get<std::vector<double>>(), s.value("mesh.cells").get<std::vector<int>>(),
            text(s, "mesh.diagonal")};
}

TimeSpec read_time(const Settings& s) {
    const double end = number(s, "time.end");
    const int steps = s.has("time.steps") ? integer(s, "time.steps") : steps_of(end, number(s, "time.step"));
    return {end, steps, text(s, "time.scheme")};
}

std::optional<Material> read_material(const Settings& s) {
    if (!s.written("material")) {
        return std::nullopt;
    }
    Material material;
    material.density = optional_number(s, "material.density");
    const bool strain = is_isotropic_plane_strain(s);
    if (s.has("material.elasticity.tensor")) {
        material.elasticity = general_tensor(flat(s.value("material.elasticity.tensor")));
    } else if (s.has("material.elasticity.young")) {
        material.elasticity = isotropic_elasticity(number(s, "material.elasticity.young"),
                                                   number(s, "material.elasticity.poisson"), strain);
    }
    if (s.has("material.viscosity.tensor")) {
        material.viscosity = general_tensor(flat(s.value("material.viscosity.tensor")));
    } else if (s.has("material.viscosity.trace")) {
        material.viscosity = isotropic_viscosity(number(s, "material.viscosity.trace"),
                                                 number(s, "material.viscosity.shear"), strain);
    }
    return material;
}

std::optional<Heat> read_heat(const Settings& s) {
    if (!s.written("heat")) {
        return std::nullopt;
    }
    Heat heat;
    heat.capacity = optional_number(s, "heat.capacity");
    heat.conductivity = symmetric_tensor(s, "heat.conductivity");
    heat.source = optional_expression(s, "heat.source");
    heat.thermal_stress = symmetric_tensor(s, "heat.thermal_stress");
    heat.strain_heating = symmetric_tensor(s, "heat.strain_heating");
    if (heat.thermal_stress && s.value("heat.thermal_stress").is_number() && is_isotropic_plane_strain(s)) {
        heat.thermal_stress->out_of_plane = number(s, "heat.thermal_stress");
    }
    return heat;
}

std::optional<Contact> read_contact(const Settings& s, const std::string& at) {
    if (!s.written(at)) {
        return std::nullopt;
    }
    Contact contact;
    contact.gap = to_expression(s.value(at + ".gap"));
    contact.quadrature = s.value(at + ".quadrature") == "vertex" ? 0 : integer(s, at + ".quadrature");
    if (s.written(at + ".compliance")) {
        contact.compliance = {number(s, at + ".compliance.stiffness"),
                              number(s, at + ".compliance.exponent")};
    }
    if (s.written(at + ".friction")) {
        contact.friction = {number(s, at + ".friction.coefficient"),
                            number(s, at + ".friction.regularisation")};
    }
    if (const std::string law = at + ".conductance"; s.written(law)) {
        contact.conductance = {number(s, law + ".coefficient"), number(s, law + ".onset"),
                               to_expression(s.value(law + ".foundation_temperature"))};
        if (s.has(law + ".limit")) {
            contact.conductance->limit = number(s, law + ".limit");
        }
    }
    return contact;
}

Boundary read_boundary(const Settings& s, const std::string& name) {
    const std::string at = "boundary." + name;
    return {free_expressions(s, at + ".displacement"), expressions(s, at + ".traction"),
            optional_expression(s, at + ".temperature"), optional_expression(s, at + ".heat_flux"),
            read_contact(s, at + ".contact")};
}

void complete_fields(Settings& s) {
    if (!s.has("output.fields")) {
        Setting& fields = s.by_name["output.fields"];
        fields.key = find_key("output.fields");
        fields.value = existing_fields(s);
        s.in_schema_order.emplace_back("output.fields");
    }
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    const Document document = read_document(path, overrides);
    Settings s = check_document(document);
    check_rules(s);
    complete_fields(s);

    Scene scene;
    scene.title = text(s, "title");
    scene.path = path;
    scene.dimension = dimension;
    scene.degree = integer(s, "space.degree");
    scene.mesh = read_mesh(s);
    scene.time = read_time(s);
    scene.material = read_material(s);
    scene.heat = read_heat(s);
    scene.body_force = expressions(s, "load.body_force");
    scene.initial = {expressions(s, "initial.displacement"), expressions(s, "initial.velocity"),
                     optional_expression(s, "initial.temperature")};
    for (const std::string& name : s.boundaries) {
        scene.boundaries.emplace(name, read_boundary(s, name));
    }
    scene.solver = {text(s, "solver.strategy"), number(s, "solver.tolerance"),
                    integer(s, "solver.max_iterations")};
    scene.output = {integer(s, "output.every"), s.value("output.fields").get<std::vector<std::string>>()};
    scene.resolved = s.resolved();
    return scene;
}

}  // namespace thermocontact::scene

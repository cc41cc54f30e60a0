#include "scene/reader.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "error.h"
#include "mesh/mesh.h"
#include "scene/document.h"
#include "scene/law_reader.h"
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

Expression to_expression(const Settings& s, const json& value) {
    return value.is_string() ? Expression(value.get<std::string>(), s.body.dimension)
                             : Expression(value.get<double>());
}

std::optional<Expression> optional_expression(const Settings& s, const std::string& name) {
    return s.has(name) ? std::optional(to_expression(s, s.value(name))) : std::nullopt;
}

/// Empty when the key is absent.
std::vector<Expression> expressions(const Settings& s, const std::string& name) {
    std::vector<Expression> list;
    if (s.has(name)) {
        for (const auto& item : s.value(name)) {
            list.push_back(to_expression(s, item));
        }
    }
    return list;
}

std::vector<std::optional<Expression>> free_expressions(const Settings& s, const std::string& name) {
    std::vector<std::optional<Expression>> list;
    if (s.has(name)) {
        for (const auto& item : s.value(name)) {
            list.push_back(item == "free" ? std::nullopt : std::optional(to_expression(s, item)));
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

/// How the body deforms.
Kinematics kinematics_of(const Settings& s) {
    if (s.body.dimension == 3) {
        return Kinematics::space;
    }
    return is_plane_strain(s) ? Kinematics::plane_strain : Kinematics::plane_stress;
}

/// The tensor of a key if it is there; a number is a multiple of the identity.
void read_tensor(const Settings& s, const std::string& name, std::optional<SymmetricTensor>& tensor) {
    if (s.has(name)) {
        const json& value = s.value(name);
        tensor = SymmetricTensor{value.is_number() ? scaled_identity(value.get<double>(), s.body.dimension)
                                                   : flat(value)};
    }
}

std::optional<Refinement> read_refinement(const Settings& s) {
    const std::string at = "mesh.refinement.";
    if (!s.has(at + "tolerance")) {
        return std::nullopt;
    }
    return Refinement{number(s, at + "tolerance"), integer(s, at + "every"), integer(s, at + "max_cells"),
                      integer(s, at + "max_level")};
}

MeshSpec read_mesh(const Settings& s) {
    if (s.body.mesh) {
        return {"", {}, {}, {}, "", "", s.body.mesh, {}, read_refinement(s)};
    }
    return {text(s, "mesh.shape"),
            s.value("mesh.lower").get<std::vector<double>>(),
            s.value("mesh.upper").get<std::vector<double>>(),
            s.value("mesh.cells").get<std::vector<int>>(),
            s.has("mesh.diagonal") ? text(s, "mesh.diagonal") : "",
            text(s, "mesh.cell"),
            nullptr,
            grading_of(s),
            read_refinement(s)};
}

TimeSpec read_time(const Settings& s) {
    const double end = number(s, "time.end");
    const int steps = s.has("time.steps") ? integer(s, "time.steps") : steps_of(end, number(s, "time.step"));
    TimeSpec time{end, steps, text(s, "time.scheme")};
    static const std::map<std::string, double> radii{{"bdf2", 0.0}, {"midpoint", 1.0}};
    if (const auto radius = radii.find(time.scheme); radius != radii.end()) {
        time.spectral_radius = radius->second;
    } else if (s.has("time.spectral_radius")) {
        time.spectral_radius = number(s, "time.spectral_radius");
    }
    if (s.has("time.tolerance")) {
        time.tolerance = number(s, "time.tolerance");
    }
    if (s.has("time.coupling_tolerance")) {
        time.coupling_tolerance = number(s, "time.coupling_tolerance");
    }
    return time;
}

/// The tensor of a law file where its table is written, its parameters over those of `tensor`.
void read_own(const Settings& s, const std::string& kind, const std::string& at,
              std::optional<VoigtTensor>& tensor) {
    if (s.law(kind) != nullptr && s.written(at + "." + kind)) {
        tensor = VoigtTensor{{}, {}, read_law(s, kind, at, tensor ? *tensor->own : Law{})};
    }
}

/// The laws that are written below `at` ("" or "region.NAME.") over those of `material`.
Material read_material(const Settings& s, const std::string& at, Material material) {
    const Kinematics kinematics = kinematics_of(s);
    if (const std::string key = at + "material.density"; s.has(key)) {
        material.density = number(s, key);
    }
    if (const std::string law = at + "material.elasticity"; s.law("elasticity") != nullptr) {
        read_own(s, "elasticity", at + "material", material.elasticity);
    } else if (s.has(law + ".tensor")) {
        material.elasticity = general_tensor(flat(s.value(law + ".tensor")));
    } else if (s.has(law + ".young")) {
        material.elasticity =
            isotropic_elasticity(number(s, law + ".young"), number(s, law + ".poisson"), kinematics);
    }
    if (const std::string law = at + "material.viscosity"; s.law("viscosity") != nullptr) {
        read_own(s, "viscosity", at + "material", material.viscosity);
    } else if (s.has(law + ".tensor")) {
        material.viscosity = general_tensor(flat(s.value(law + ".tensor")));
    } else if (s.has(law + ".trace")) {
        material.viscosity =
            isotropic_viscosity(number(s, law + ".trace"), number(s, law + ".shear"), kinematics);
    }
    return material;
}

/// The same for heat.
Heat read_heat(const Settings& s, const std::string& at, Heat heat) {
    if (const std::string key = at + "heat.capacity"; s.has(key)) {
        heat.capacity = number(s, key);
    }
    if (const std::string key = at + "heat.source"; s.law("source") != nullptr && s.written(key)) {
        heat.own_source = read_law(s, "source", at + "heat", heat.own_source.value_or(Law{}));
    } else if (s.has(key)) {
        heat.source = to_expression(s, s.value(key));
    }
    read_tensor(s, at + "heat.conductivity", heat.conductivity);
    read_tensor(s, at + "heat.thermal_stress", heat.thermal_stress);
    read_tensor(s, at + "heat.strain_heating", heat.strain_heating);
    read_tensor(s, at + "heat.strain_rate_heating", heat.strain_rate_heating);
    const std::string coupling = at + "heat.thermal_stress";
    if (s.has(coupling) && s.value(coupling).is_number() && kinematics_of(s) == Kinematics::plane_strain) {
        heat.thermal_stress->out_of_plane = number(s, coupling);
    }
    return heat;
}

std::map<std::string, Region> read_regions(const Settings& s, const Scene& scene) {
    std::map<std::string, Region> regions;
    for (const std::string& name : s.regions) {
        const std::string at = "region." + name + ".";
        Region region{scene.material, scene.heat};
        if (region.material) {
            region.material = read_material(s, at, *region.material);
        }
        if (region.heat) {
            region.heat = read_heat(s, at, *region.heat);
        }
        regions.emplace(name, std::move(region));
    }
    return regions;
}

std::optional<Contact> read_contact(const Settings& s, const std::string& at) {
    if (!s.written(at)) {
        return std::nullopt;
    }
    Contact contact;
    contact.gap = to_expression(s, s.value(at + ".gap"));
    contact.foundation_velocity = expressions(s, at + ".foundation_velocity");
    contact.quadrature = s.value(at + ".quadrature") == "vertex" ? 0 : integer(s, at + ".quadrature");
    if (s.written(at + ".compliance")) {
        contact.compliance = read_law(s, "compliance", at);
    }
    if (s.written(at + ".friction")) {
        contact.friction = {read_law(s, "friction", at), number(s, at + ".friction.regularisation")};
        if (s.has(at + ".friction.heat_share")) {
            contact.friction->heat_share = number(s, at + ".friction.heat_share");
        }
    }
    if (s.written(at + ".conductance")) {
        contact.conductance = {read_law(s, "conductance", at),
                               to_expression(s, s.value(at + ".conductance.foundation_temperature"))};
    }
    return contact;
}

/// Takes the kernels of the law files into the scene.
void read_kernels(const Settings& s, Scene& scene) {
    std::vector<laws::LawFile> files;
    for (const OwnLaw& law : s.laws) {
        files.push_back(law.file);
        scene.laws[law.file.kind] = law.file.digest;
    }
    if (files.empty()) {
        return;
    }
    const bool tensor = scene.mesh.cell == "tensor";
    const std::string plane = tensor ? "quadrilateral" : "triangle",
                      solid = tensor ? "hexahedron" : "tetrahedron";
    const std::string cell = s.body.mesh ? s.body.mesh->cell : scene.dimension == 2 ? plane : solid;
    try {
        scene.kernels =
            laws::kernels(files, {cell, scene.degree, scene.dimension == 2 && is_plane_strain(s)});
    } catch (const SceneError& error) {
        fail_at(s, "forms", error.what());
    }
}

std::optional<Convection> read_convection(const Settings& s, const std::string& at) {
    if (!s.written(at)) {
        return std::nullopt;
    }
    return Convection{number(s, at + ".coefficient"), to_expression(s, s.value(at + ".ambient_temperature"))};
}

std::optional<Spring> read_spring(const Settings& s, const std::string& at) {
    std::optional<SymmetricTensor> stiffness;
    read_tensor(s, at + ".stiffness", stiffness);
    return stiffness ? std::optional(Spring{*stiffness, expressions(s, at + ".anchor")}) : std::nullopt;
}

Boundary read_boundary(const Settings& s, const std::string& name) {
    const std::string at = "boundary." + name;
    return {free_expressions(s, at + ".displacement"),
            expressions(s, at + ".traction"),
            read_spring(s, at + ".spring"),
            optional_expression(s, at + ".temperature"),
            optional_expression(s, at + ".heat_flux"),
            read_convection(s, at + ".convection"),
            read_contact(s, at + ".contact")};
}

std::vector<std::string> names_in_force(const Settings& s, const std::string& prefix) {
    std::vector<std::string> names;
    std::ranges::copy_if(s.in_schema_order, std::back_inserter(names),
                         [&](const std::string& name) { return name.starts_with(prefix); });
    return names;
}

/// Takes keys out of force that mean nothing in this body.
void drop_meaningless(Settings& s) {
    const auto drop = [&](const std::string& name) {
        s.by_name.erase(name);
        std::erase(s.in_schema_order, name);
    };
    if (s.body.dimension == 3) {
        drop("material.elasticity.plane");
    }
    if (text(s, "time.scheme") != "generalized-alpha") {
        drop("time.spectral_radius");
    }
    if (!s.written("material") || !s.written("heat")) {
        drop("time.coupling");
    }
    if (!s.has("time.coupling") || text(s, "time.coupling") == "lagged") {
        drop("time.coupling_tolerance");
    }
    if (s.has("mesh.cell") && (s.body.dimension == 3 || text(s, "mesh.cell") == "tensor")) {
        drop("mesh.diagonal");
    }
    for (const std::string& key : names_in_force(s, "mesh.grading.")) {
        if (number(s, key) == 1) {  // uniform, as without it
            drop(key);
        }
    }
}

void complete_fields(Settings& s) {
    if (!s.has("output.fields")) {
        Setting& fields = s.by_name["output.fields"];
        fields.key = s.schema->find("output.fields");
        fields.value = existing_fields(s);
        s.in_schema_order.emplace_back("output.fields");
    }
}

}  // namespace

Scene read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    const Document document = read_document(path, overrides);
    Settings s = check_document(document);
    check_rules(s);
    drop_meaningless(s);
    complete_fields(s);

    Scene scene;
    scene.title = text(s, "title");
    scene.path = path;
    scene.dimension = s.body.dimension;
    scene.degree = integer(s, "space.degree");
    scene.mesh = read_mesh(s);
    scene.time = read_time(s);
    if (s.written("material")) {
        scene.material = read_material(s, "", {});
    }
    if (s.written("heat")) {
        scene.heat = read_heat(s, "", {});
    }
    scene.regions = read_regions(s, scene);
    if (s.law("body_force") != nullptr) {
        scene.own_body_force = read_law(s, "body_force", "load");
    } else {
        scene.body_force = expressions(s, "load.body_force");
    }
    scene.initial = {expressions(s, "initial.displacement"), expressions(s, "initial.velocity"),
                     optional_expression(s, "initial.temperature")};
    for (const std::string& name : s.boundaries) {
        scene.boundaries.emplace(name, read_boundary(s, name));
    }
    scene.solver = {text(s, "solver.strategy"), number(s, "solver.tolerance"),
                    integer(s, "solver.max_iterations"), text(s, "solver.factor")};
    scene.output = {integer(s, "output.every"), s.value("output.fields").get<std::vector<std::string>>()};
    if (s.has("output.checkpoint_every")) {
        scene.output.checkpoint_every = integer(s, "output.checkpoint_every");
    }
    read_kernels(s, scene);
    scene.resolved = s.resolved();
    return scene;
}

}  // namespace thermocontact::scene

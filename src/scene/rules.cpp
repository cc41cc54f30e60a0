// What several keys must fulfil together.

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/mesh.h"
#include "scene/expression.h"
#include "scene/settings.h"
#include "scene/tensors.h"
#include "scene/text.h"
#include "scene/time_steps.h"

namespace thermocontact::scene {

namespace {

using nlohmann::json;

constexpr double most_cells = 1e8;  // keeps every count of a mesh within 32 bits

/// Plane states of stress and diagonals of rectangles have no meaning in space.
void check_plane_keys(const Settings& settings) {
    for (const auto& [name, setting] : settings.by_name) {
        const bool is_plane = setting.key->leaf() == "plane" || name == "mesh.diagonal";
        if (is_plane && settings.written(name) && settings.body.dimension == 3) {
            fail_at(settings, name, "the body has three dimensions; leave it out");
        }
    }
}

/// Only simplices can be bisected into their own kind, and something must tell where.
void check_refinement(const Settings& settings) {
    const std::string key = "mesh.refinement.tolerance";
    if (!settings.written(key)) {
        return;
    }
    if (settings.body.mesh && settings.body.mesh->vertices_per_cell != settings.body.dimension + 1) {
        fail_at(settings, key, "needs triangles or tetrahedra, the " + settings.body.what + " has others");
    }
    if (!settings.body.mesh && settings.value("mesh.cell") != "simplex") {
        fail_at(settings, key,
                "needs triangles or tetrahedra: mesh.cell = \"simplex\", found " +
                    show(settings.value("mesh.cell")));
    }
    const auto written = [&](const char* law) { return settings.written(law); };
    if (!written("material.elasticity") && !written("material.viscosity") && !written("heat.conductivity")) {
        fail_at(
            settings, key,
            "needs material.elasticity, material.viscosity or heat.conductivity, whose energies the error "
            "is measured in");
    }
}

void check_mesh(const Settings& settings) {
    if (settings.written("mesh.file")) {
        return;
    }
    const json& lower = settings.value("mesh.lower");
    const json& upper = settings.value("mesh.upper");
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const double length = upper[i].get<double>() - lower[i].get<double>();
        if (std::isfinite(length) && length > 0) {
            continue;
        }
        if (settings.written("mesh.upper")) {
            fail_at(settings, "mesh.upper",
                    "expected to exceed mesh.lower = " + show(lower) + " in every component, found " +
                        show(upper));
        }
        fail_at(
            settings, "mesh.lower",
            "expected to be below mesh.upper = " + show(upper) + " in every component, found " + show(lower));
    }
    double cells = 1;
    for (const auto& count : settings.value("mesh.cells")) {
        cells *= count.get<double>();
    }
    if (cells > most_cells) {
        fail_at(settings, "mesh.cells",
                "expected at most " + number_text(most_cells) + " cells, found " + number_text(cells));
    }
    check_grading(settings);
}

/// A key that is written has to have the choice that it is about.
void check_choice(const Settings& settings, const std::string& name, const std::string& key,
                  const std::string& choice) {
    if (settings.written(name) && settings.value(key) != choice) {
        fail_at(settings, name, "needs " + key + " = \"" + choice + "\", found " + show(settings.value(key)));
    }
}

void check_time(const Settings& settings) {
    if (settings.written("time.tolerance") && settings.value("time.scheme") == "midpoint") {
        fail_at(settings, "time.tolerance",
                "needs a time.scheme that damps: \"backward-euler\", \"bdf2\" or \"generalized-alpha\"; "
                "under \"midpoint\" fast motions ring on and their rates say nothing of the error");
    }
    check_choice(settings, "time.spectral_radius", "time.scheme", "generalized-alpha");
    check_choice(settings, "time.coupling_tolerance", "time.coupling", "iterated");
    const Setting* step = settings.find("time.step");
    if (step == nullptr) {
        return;
    }
    const double end = settings.value("time.end").get<double>();
    if (steps_of(end, step->value.get<double>()) == 0) {
        fail_at(settings, "time.step",
                "expected a step that divides time.end = " + number_text(end) + " into at most " +
                    std::to_string(most_steps) + " equal steps, found " + show(step->value));
    }
}

void check_physics(const Settings& settings) {
    if (!settings.written("material") && !settings.written("heat")) {
        fail({.source = settings.document->file},
             "material: missing; a scene needs [material] or [heat] or both");
    }
    if (settings.written("material") && !settings.written("material.elasticity") &&
        !settings.written("material.viscosity")) {
        fail_at(settings, "material", "needs [material.elasticity] or [material.viscosity] or both");
    }
    if (settings.written("heat") && !settings.written("heat.capacity") &&
        !settings.written("heat.conductivity")) {
        fail_at(settings, "heat", "needs capacity or conductivity or both");
    }
}

bool is_finite(const VoigtTensor& tensor) {
    for (const auto& values : {tensor.matrix, tensor.out_of_plane}) {
        for (const double value : values) {
            if (!std::isfinite(value)) {
                return false;
            }
        }
    }
    return true;
}

/// `at`: "" or "region.NAME.".
void check_isotropic(const Settings& settings, const std::string& at) {
    const int d = settings.body.dimension;
    if (const std::string law = at + "material.viscosity"; settings.has(law + ".trace")) {
        const double mu1 = settings.value(law + ".trace").get<double>();
        const double mu2 = settings.value(law + ".shear").get<double>();
        if (!is_finite(isotropic_viscosity(mu1, mu2, plane_strain(d))) || d * mu1 + mu2 < 0) {
            fail_at(settings, law + ".trace",
                    "expected a number >= -shear/" + std::to_string(d) + " = " + number_text(-mu2 / d) +
                        " (Pa s) so that viscosity never produces energy, found " + number_text(mu1));
        }
    }
    if (const std::string law = at + "material.elasticity"; settings.has(law + ".young")) {
        const double young = settings.value(law + ".young").get<double>();
        const double poisson = settings.value(law + ".poisson").get<double>();
        if (!is_finite(isotropic_elasticity(young, poisson, plane_strain(d)))) {
            fail_at(settings, law + ".young", "the elasticity tensor overflows, found " + number_text(young));
        }
    }
}

/// A body is in plane stress or in plane strain as a whole.
void check_planes(const Settings& settings) {
    const Setting* general = settings.find("material.elasticity.plane");
    for (const std::string& region : settings.regions) {
        const Setting* own = settings.find("region." + region + ".material.elasticity.plane");
        if (own != nullptr && general != nullptr && own->value != general->value) {
            fail_at(
                settings, "region." + region + ".material.elasticity.plane",
                "expected that of the whole body, " + show(general->value) + ", found " + show(own->value));
        }
    }
}

/// Component of the traction that acts against a prescribed displacement, or -1.
int traction_on_prescribed(const Settings& settings, const std::string& at) {
    if (!settings.has(at + "traction") || !settings.has(at + "displacement")) {
        return -1;
    }
    const json& traction = settings.value(at + "traction");
    const json& displacement = settings.value(at + "displacement");
    for (int i = 0; i < settings.body.dimension; ++i) {
        const auto component = static_cast<std::size_t>(i);
        const json& f = traction[component];
        const Expression value = f.is_string() ? Expression(f.get<std::string>(), settings.body.dimension)
                                               : Expression(f.get<double>());
        if (displacement[component] != "free" && !value.is_zero()) {
            return i;
        }
    }
    return -1;
}

bool is_fully_prescribed(const Settings& settings, const std::string& name) {
    if (!settings.has(name)) {
        return false;
    }
    const nlohmann::json& components = settings.value(name);
    return std::all_of(components.begin(), components.end(),
                       [](const nlohmann::json& component) { return component != "free"; });
}

[[noreturn]] void fail_pair(const Settings& settings, const std::string& a, const std::string& b,
                            const std::string& message) {
    const Entry* first = settings.document->find(a);
    const Entry* second = settings.document->find(b);
    if (second < first) {
        std::swap(first, second);
    }
    fail(second->where,
         second->key + ": conflicts with " + first->key + " (" + first->where.brief() + "): " + message);
}

/// The multiplier of exact friction is a function of degree 2 on each facet (model/friction_multiplier.h),
/// which cannot take any values at the points of every rule: not at more than it has coefficients, nor at the
/// 6 points of degree 3 on a triangle, which lie on an ellipse.
void check_exact_friction(const Settings& settings, const std::string& contact) {
    const std::string epsilon = contact + "friction.regularisation";
    const json rule = settings.has(contact + "quadrature") ? settings.value(contact + "quadrature") : json(4);
    const auto served = {json("vertex"), json(1), json(2), json(4)};
    if (settings.written(epsilon) && settings.value(epsilon) == 0 &&
        std::find(served.begin(), served.end(), rule) == served.end()) {
        fail_at(settings, contact + "quadrature",
                "expected 1, 2, 4 or \"vertex\" where friction.regularisation = 0, found " + show(rule));
    }
}

void check_boundary(const Settings& settings, const std::string& boundary) {
    const std::string at = "boundary." + boundary + ".";
    if (const int i = traction_on_prescribed(settings, at); i >= 0) {
        const std::string component(1, "xyz"[i]);
        fail_pair(settings, at + "displacement", at + "traction",
                  "the " + component + " component is both prescribed and loaded; make it \"free\" or 0");
    }
    if (settings.written(at + "spring") && is_fully_prescribed(settings, at + "displacement")) {
        fail_pair(settings, at + "displacement", at + "spring",
                  "every displacement component is prescribed; make one \"free\"");
    }
    if (settings.written(at + "contact.compliance") && is_fully_prescribed(settings, at + "displacement")) {
        fail_pair(settings, at + "displacement", at + "contact.compliance",
                  "every displacement component is prescribed; make one \"free\"");
    }
    check_exact_friction(settings, at + "contact.");
    if (settings.written(at + "contact") && !settings.written(at + "contact.compliance") &&
        !settings.written(at + "contact.conductance")) {
        fail_at(settings, at + "contact",
                "needs [" + at + "contact.compliance] or [" + at + "contact.conductance]");
    }
}

void check_fields(const Settings& settings) {
    const Setting* fields = settings.find("output.fields");
    if (fields == nullptr) {
        return;
    }
    const auto existing = existing_fields(settings);
    for (const auto& item : fields->value) {
        const auto field = item.get<std::string>();
        if (std::find(existing.begin(), existing.end(), field) == existing.end()) {
            fail_at(settings, "output.fields",
                    "\"" + field + "\" is no field of this scene, which has " + one_of(existing));
        }
    }
}

}  // namespace

std::vector<std::string> existing_fields(const Settings& settings) {
    const bool contact = !settings.boundaries_with("boundary.NAME.contact").empty();
    std::vector<std::string> fields;
    for (const std::string& field : settings.schema->find("output.fields")->choices) {
        const bool exists = field == "contact"       ? contact
                            : field == "temperature" ? settings.written("heat")
                                                     : settings.written("material");
        if (exists) {
            fields.push_back(field);
        }
    }
    return fields;
}

void check_rules(const Settings& settings) {
    check_mesh(settings);
    check_refinement(settings);
    check_time(settings);
    check_physics(settings);
    check_laws(settings);
    check_plane_keys(settings);
    check_isotropic(settings, "");
    for (const std::string& region : settings.regions) {
        check_isotropic(settings, "region." + region + ".");
    }
    check_planes(settings);
    for (const std::string& boundary : settings.boundaries) {
        check_boundary(settings, boundary);
    }
    check_fields(settings);
}

}  // namespace thermocontact::scene

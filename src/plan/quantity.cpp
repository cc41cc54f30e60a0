#include "plan/quantity.h"

#include <algorithm>

#include "error.h"
#include "model/physics.h"
#include "scene/text.h"

namespace thermocontact::plan {
namespace {

bool has_contact(const scene::Scene& scene) {
    return std::ranges::any_of(scene.boundaries,
                               [](const auto& entry) { return entry.second.contact.has_value(); });
}

/// What the scene lacks for the quantity; empty: nothing.
std::string lack(Quantity quantity, const scene::Scene& scene) {
    switch (quantity) {
        case Quantity::peak_pressure:
        case Quantity::contact_force:
            return model::has_compliance(scene) ? "" : "contact with a compliance";
        case Quantity::contact_share:
            return has_contact(scene) ? "" : "contact";
        case Quantity::temperature:
            return scene.heat ? "" : "heat";
        default:
            return "";
    }
}

}  // namespace

const std::vector<std::string>& quantity_names() {
    static const std::vector<std::string> names = {"norms", "peak_pressure", "contact_force", "temperature",
                                                   "contact_share"};
    return names;
}

const std::string& name(Quantity quantity) {
    return quantity_names()[static_cast<std::size_t>(quantity)];
}

Quantity quantity_of(const std::string& word) {
    const std::vector<std::string>& names = quantity_names();
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) {
        throw SceneError("--of: expected " + scene::one_of(names) + ", found \"" + scene::one_line(word) +
                         '"' + scene::did_you_mean(word, names));
    }
    return static_cast<Quantity>(found - names.begin());
}

std::vector<std::string> components_of(Quantity quantity, const scene::Scene& scene) {
    if (const std::string lacking = lack(quantity, scene); !lacking.empty()) {
        throw SceneError("--of " + name(quantity) + ": the scene has no " + lacking);
    }
    if (quantity != Quantity::norms) {
        return {name(quantity)};
    }
    std::vector<std::string> components;
    if (scene.material) {
        if (scene.material->density) {
            components.emplace_back("velocity");
        }
        components.emplace_back("strain");
    }
    if (scene.heat) {
        components.emplace_back("temperature");
    }
    return components;
}

}  // namespace thermocontact::plan

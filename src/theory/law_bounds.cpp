#include "theory/law_bounds.h"

#include <algorithm>
#include <limits>

namespace thermocontact::theory {

LawBounds bounds_of_laws(const std::string& name, const scene::Boundary& boundary) {
    LawBounds bounds;
    if (!boundary.contact) {
        return bounds;
    }
    const scene::Contact& contact = *boundary.contact;
    const std::optional<scene::Law>& compliance = contact.compliance;
    const std::optional<scene::Friction>& friction = contact.friction;
    const std::optional<scene::Conductance>& conductance = contact.conductance;
    bounds.own_contact =
        (compliance && !compliance->file.empty()) || (friction && !friction->law.file.empty());
    bounds.own_exchange = conductance && !conductance->law.file.empty();
    if (compliance && !bounds.own_contact) {
        const double exponent = compliance->constants.at("m");
        bounds.L_nu =
            exponent == 1 ? compliance->constants.at("c_n") : std::numeric_limits<double>::infinity();
        if (friction && friction->law.constants.at("mu") > 0) {
            bounds.L_tau = friction->law.constants.at("mu") * bounds.L_nu;
        }
        bounds.not_lipschitz = exponent == 1 ? "" : name;
    }
    if (conductance && !bounds.own_exchange) {
        const auto& law = conductance->law.constants;
        bounds.M_kc = law.at("k_c");
        bounds.L_kc = law.at("k_c") / law.at("eps_c");
    }
    return bounds;
}

LawBounds bounds_of_laws(const scene::Scene& scene) {
    LawBounds bounds;
    for (const auto& [name, boundary] : scene.boundaries) {
        const LawBounds own = bounds_of_laws(name, boundary);
        bounds.L_nu = std::max(bounds.L_nu, own.L_nu);
        bounds.L_tau = std::max(bounds.L_tau, own.L_tau);
        bounds.M_kc = std::max(bounds.M_kc, own.M_kc);
        bounds.L_kc = std::max(bounds.L_kc, own.L_kc);
        bounds.own_contact = bounds.own_contact || own.own_contact;
        bounds.own_exchange = bounds.own_exchange || own.own_exchange;
        if (!own.not_lipschitz.empty()) {
            bounds.not_lipschitz += (bounds.not_lipschitz.empty() ? "" : ", ") + own.not_lipschitz;
        }
    }
    return bounds;
}

}  // namespace thermocontact::theory

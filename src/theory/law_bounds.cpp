#include "theory/law_bounds.h"

#include <algorithm>
#include <limits>

namespace thermocontact::theory {

LawBounds bounds_of_laws(const std::string& name, const scene::Boundary& boundary) {
    LawBounds bounds;
    if (boundary.contact && boundary.contact->compliance) {
        const auto& [stiffness, exponent] = *boundary.contact->compliance;
        bounds.L_nu = exponent == 1 ? stiffness : std::numeric_limits<double>::infinity();
        if (boundary.contact->friction && boundary.contact->friction->coefficient > 0) {
            bounds.L_tau = boundary.contact->friction->coefficient * bounds.L_nu;
        }
        bounds.not_lipschitz = exponent == 1 ? "" : name;
    }
    if (boundary.contact && boundary.contact->conductance) {
        const scene::Conductance& law = *boundary.contact->conductance;
        bounds.M_kc = law.coefficient;
        bounds.L_kc = law.coefficient / law.onset;
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
        if (!own.not_lipschitz.empty()) {
            bounds.not_lipschitz += (bounds.not_lipschitz.empty() ? "" : ", ") + own.not_lipschitz;
        }
    }
    return bounds;
}

}  // namespace thermocontact::theory

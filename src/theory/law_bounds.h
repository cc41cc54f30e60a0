/// The numbers of the contact laws that (H7), (H8) and (2.23) speak of.
#pragma once

#include <string>

#include "scene/scene.h"

namespace thermocontact::theory {

struct LawBounds {
    double L_nu = 0;            ///< Lipschitz constant of p_nu, Pa/m; infinite with an exponent other than 1
    double L_tau = 0;           ///< of p_tau
    double M_kc = 0;            ///< least upper bound of k_c, W/(m^2 K)
    double L_kc = 0;            ///< Lipschitz constant of k_c, W/(m^3 K)
    std::string not_lipschitz;  ///< boundaries whose p_nu is not
    bool own_contact = false, own_exchange = false;  ///< p_nu or p_tau, k_c of a law file: no numbers known
};

/// Those of one boundary's laws.
LawBounds bounds_of_laws(const std::string& name, const scene::Boundary& boundary);

/// The largest over all boundaries.
LawBounds bounds_of_laws(const scene::Scene& scene);

}  // namespace thermocontact::theory

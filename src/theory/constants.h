/// The constants of the paper's inequalities (2.12)-(2.15) on the scene's own mesh, degree and prescribed
/// sides.
///
/// They are those of the finite element spaces: refinement in nested meshes raises s1 and s2 towards those of
/// V and Q, and lowers c_k and c_f.
#pragma once

#include <optional>

#include "fem/space.h"
#include "scene/scene.h"

namespace thermocontact::theory {

/// Of fields that vanish where the displacement (V) or temperature (Q) is prescribed. Where the prescribed
/// values do not hold the body, no such inequality exists: c_k = c_f = 0, s1 = s2 = infinity.
struct Constants {
    std::optional<double>
        c_k;  ///< ||eps(v)|| >= c_k ||v||_H1, ||v||_H1^2 = ||v||^2 + ||eps(v)||^2; with mechanics
    std::optional<double> c_f;  ///< ||grad eta|| >= c_f ||eta||, 1/m; with heat
    std::optional<double> s1;   ///< ||v||_L2(Gamma_C) <= s1 ||eps(v)||, m^(1/2); with compliance
    std::optional<double> s2;   ///< ||eta||_L2(Gamma_C) <= s2 ||grad eta||, m^(1/2); with conductance
    double relative_error = 0;  ///< at most, of those that are neither 0 nor infinite
};

/// Throws NumericsError if an eigenvalue does not converge.
Constants find_constants(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);

}  // namespace thermocontact::theory

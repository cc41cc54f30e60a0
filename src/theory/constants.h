/// The constants of the paper's inequalities (2.12)-(2.15) on the scene's own mesh, degree and prescribed
/// sides.
///
/// They are those of the finite element spaces: refinement in nested meshes raises s1 and s2 towards those of
/// V and Q, and lowers c_k and c_f.
///
/// (2.23) bounds the body's operators by their worst region and the laws by their worst boundary. r_a and r_d
/// weigh the operators and laws themselves against each other: what the argument behind (2.23) needs is r_a <
/// 1 and r_d < 1.
#pragma once

#include <optional>

#include "fem/space.h"
#include "scene/scene.h"
#include "theory/pieces.h"

namespace thermocontact::theory {

/// Of fields that vanish where the displacement (V) or temperature (Q) is prescribed. Where the prescribed
/// values do not hold the body, no such inequality exists: c_k = c_f = 0, s1 = s2 = infinity.
struct Constants {
    std::optional<double>
        c_k;  ///< ||eps(v)|| >= c_k ||v||_H1, ||v||_H1^2 = ||v||^2 + ||eps(v)||^2; with mechanics
    std::optional<double> c_f;  ///< ||grad eta|| >= c_f ||eta||, 1/m; with heat
    std::optional<double> s1;   ///< ||v||_L2(Gamma_C) <= s1 ||eps(v)||, m^(1/2); with compliance
    std::optional<double> s2;   ///< ||eta||_L2(Gamma_C) <= s2 ||grad eta||, m^(1/2); with conductance
    std::optional<double> r_a;  ///< int_Gamma_C (L_nu + L_tau) |v|^2 <= r_a ((E eps(v), eps(v)) + int k_s
                                ///< v.v); as s1, if (H2 i)
    std::optional<double> r_d;  ///< int_Gamma_C M_kc eta^2 <= r_d (K grad eta, grad eta); as s2, if (H3 ii)
    double relative_error = 0;  ///< at most, of those that are neither 0 nor infinite
};

/// Throws NumericsError if an eigenvalue does not converge.
Constants find_constants(const scene::Scene& scene, const std::vector<Piece>& pieces, const mesh::Mesh& mesh,
                         const fem::Space& space);

}  // namespace thermocontact::theory

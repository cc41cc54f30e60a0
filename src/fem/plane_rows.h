/// What the balances of an isotropic body in the plane take of its motion, from one matrix.
///
/// With D_ij = int grad phi_i (x) grad phi_j, the blocks of (div u, div v), those of (C eps(u), eps(v)), C e
/// = trace tr(e) I + shear e, are
///
///   trace D_ij + shear/2 (tr(D_ij) I + D_ij^T).
///
/// To read a matrix takes far longer than to compute with it: stiffness, damping and the norm of the strains
/// together take little longer from D than one of them from a matrix of its own.
#pragma once

#include "fem/traversal.h"

namespace thermocontact::fem {

/// C e = trace tr(e) I + shear e.
struct Isotropic {
    double trace, shear;
};

/// elastic := (E eps(u), eps(v)), viscous := (V eps(w), eps(v)), strain_square := |eps(u)|^2 (of this
/// process).
struct PlaneProducts {
    const BlockMatrix* divergences;  ///< D: (div u, div v), two components
    Isotropic elasticity, viscosity;
    const std::vector<double>*u, *w;        ///< [nodes][2]
    std::vector<double>*elastic, *viscous;  ///< [nodes][2], their sizes already
    double* strain_square;
};

/// For Traversal::run(). What `products` refers to must stay until then.
Pass pass_of(const PlaneProducts& products);

/// The matrix of (C eps(u), eps(v)) alone.
BlockMatrix isotropic_matrix(const BlockMatrix& divergences, const Isotropic& tensor);

}  // namespace thermocontact::fem

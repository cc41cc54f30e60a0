/// Material tensors: from two constants to Voigt form, and the tests a scene's matrices
/// must pass.
///
/// Isotropic, e = symmetric gradient, 2G = E/(1+nu):
///   in space      s = lambda  tr(e) I + 2G e,  lambda  = E nu/((1+nu)(1-2nu))
///   plane stress  s = lambda* tr(e) I + 2G e,  lambda* = E nu/(1-nu^2)
///   plane strain  s = lambda  tr(e) I + 2G e,  lambda  = E nu/((1+nu)(1-2nu)),  s_zz = lambda tr(e)
///   viscosity     s = mu1 tr(e) I + mu2 e,     s_zz = mu1 tr(e) in plane strain
/// Voigt with engineering shear: (s_xx, s_yy, s_xy) = C (e_xx, e_yy, 2 e_xy), hence the shear entries are
/// G or mu2/2; in space (xx, yy, zz, yz, xz, xy).
#pragma once

#include <vector>

#include "scene/scene.h"

namespace thermocontact::scene {

enum class Kinematics { plane_stress, plane_strain, space };

/// The one of a body without free plane sides: space in three dimensions, else plane strain.
constexpr Kinematics plane_strain(int dimension) {
    return dimension == 3 ? Kinematics::space : Kinematics::plane_strain;
}

VoigtTensor isotropic_elasticity(double young, double poisson, Kinematics kinematics);
VoigtTensor isotropic_viscosity(double mu1, double mu2, Kinematics kinematics);

/// A given Voigt matrix, row-major; in 2D its zz components are unknown and taken as zero.
VoigtTensor general_tensor(std::vector<double> matrix);

/// s I in dimension d, row-major [d][d].
std::vector<double> scaled_identity(double s, int dimension);

/// Symmetric up to round-off; `matrix` row-major [n][n].
bool is_symmetric(const std::vector<double>& matrix, int n);

/// Smallest eigenvalue of a symmetric matrix, zero where it is zero up to round-off.
double smallest_eigenvalue(const std::vector<double>& matrix, int n);

}  // namespace thermocontact::scene

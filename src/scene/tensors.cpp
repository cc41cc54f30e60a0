#include "scene/tensors.h"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

namespace thermocontact::scene {

namespace {

constexpr double round_off = 1e-12;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VoigtTensor isotropic(double lambda, double mu2, bool plane_strain) {
    const double normal = lambda + mu2;
    const double zz = plane_strain ? lambda : 0.0;
    return {{normal, lambda, 0, lambda, normal, 0, 0, 0, mu2 / 2}, {zz, zz, 0}};
}

}  // namespace

VoigtTensor isotropic_elasticity(double young, double poisson, bool plane_strain) {
    const double lambda = plane_strain ? young * poisson / ((1 + poisson) * (1 - 2 * poisson))
                                       : young * poisson / (1 - poisson * poisson);
    return isotropic(lambda, young / (1 + poisson), plane_strain);
}

VoigtTensor isotropic_viscosity(double mu1, double mu2, bool plane_strain) {
    return isotropic(mu1, mu2, plane_strain);
}

VoigtTensor general_tensor(std::vector<double> matrix) {
    return {std::move(matrix), {0, 0, 0}};
}

std::vector<double> scaled_identity(double s, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<double> matrix(d * d, 0.0);
    for (std::size_t i = 0; i < d; ++i) {
        matrix[i * d + i] = s;
    }
    return matrix;
}

bool is_symmetric(const std::vector<double>& matrix, int n) {
    const Eigen::Map<const Matrix> a(matrix.data(), n, n);
    return (a - a.transpose()).cwiseAbs().maxCoeff() <= round_off * a.cwiseAbs().maxCoeff();
}

double smallest_eigenvalue(const std::vector<double>& matrix, int n) {
    const Eigen::Map<const Matrix> a(matrix.data(), n, n);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(a, Eigen::EigenvaluesOnly);
    const auto& values = solver.eigenvalues();
    const double smallest = values.minCoeff();
    return std::abs(smallest) <= round_off * values.cwiseAbs().maxCoeff() ? 0.0 : smallest;
}

}  // namespace thermocontact::scene

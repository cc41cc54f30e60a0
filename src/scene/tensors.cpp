#include "scene/tensors.h"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

namespace thermocontact::scene {

namespace {

constexpr double round_off = 1e-12;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VoigtTensor isotropic(double lambda, double mu2, Kinematics kinematics) {
    const std::size_t d = kinematics == Kinematics::space ? 3 : 2, size = d * (d + 1) / 2;
    VoigtTensor tensor{std::vector<double>(size * size, 0.0), {}};
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < d && i < d; ++j) {
            tensor.matrix[i * size + j] = lambda;
        }
        tensor.matrix[i * size + i] += i < d ? mu2 : mu2 / 2;
    }
    if (kinematics != Kinematics::space) {
        const double zz = kinematics == Kinematics::plane_strain ? lambda : 0.0;
        tensor.out_of_plane = {zz, zz, 0};
    }
    return tensor;
}

}  // namespace

VoigtTensor isotropic_elasticity(double young, double poisson, Kinematics kinematics) {
    const double lambda = kinematics == Kinematics::plane_stress
                              ? young * poisson / (1 - poisson * poisson)
                              : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    return isotropic(lambda, young / (1 + poisson), kinematics);
}

VoigtTensor isotropic_viscosity(double mu1, double mu2, Kinematics kinematics) {
    return isotropic(mu1, mu2, kinematics);
}

VoigtTensor general_tensor(std::vector<double> matrix) {
    std::vector<double> out_of_plane(matrix.size() == 9 ? 3 : 0, 0.0);
    return {std::move(matrix), std::move(out_of_plane)};
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

#include "theory/tensor_bounds.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace thermocontact::theory {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Bounds bounds_of_matrix(const Matrix& matrix) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    // an eigenvalue that is zero comes out as round-off of the largest, of either sign
    const double round_off = 10 * std::numeric_limits<double>::epsilon() * largest;
    return {std::abs(values[0]) <= round_off ? 0.0 : values[0], largest};
}

}  // namespace

Bounds bounds_of(const scene::VoigtTensor& tensor, int dimension) {
    const Eigen::Index n = dimension * (dimension + 1) / 2;
    Matrix scaled = Eigen::Map<const Matrix>(tensor.matrix.data(), n, n);
    for (Eigen::Index i = dimension; i < n; ++i) {
        scaled.row(i) *= std::sqrt(2.0);
        scaled.col(i) *= std::sqrt(2.0);
    }
    return bounds_of_matrix(scaled);
}

Bounds bounds_of(const scene::SymmetricTensor& tensor) {
    const auto n =
        static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(tensor.matrix.size()))));
    return bounds_of_matrix(Eigen::Map<const Matrix>(tensor.matrix.data(), n, n));
}

double norm_of(const scene::SymmetricTensor& tensor) {
    return Eigen::Map<const Eigen::VectorXd>(tensor.matrix.data(),
                                             static_cast<Eigen::Index>(tensor.matrix.size()))
        .norm();
}

}  // namespace thermocontact::theory

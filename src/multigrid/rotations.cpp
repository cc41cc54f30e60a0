#include "multigrid/rotations.h"

#include <Eigen/Core>
#include <Eigen/SVD>
#include <algorithm>

namespace thermocontact::multigrid {
namespace {

constexpr double symmetric = 1e-3;  ///< of a block's entries: what may be unsymmetric

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Q^T of N = Q S with N = U s V^T: V U^T.
Square turned_back(const Square& N) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> factors(N, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return factors.matrixV() * factors.matrixU().transpose();
}

}  // namespace

Rotations::Rotations(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                     const SharedNodes& nodes)
    : size_(A.rows) {
    const std::size_t length = static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
    const std::vector<double> diagonal = fine_diagonal(A, D, fixed, nodes);
    for (std::size_t node = 0; node < nodes.node_count() && size_ > 1; ++node) {
        const Square N = Eigen::Map<const Square>(diagonal.data() + node * length, size_, size_);
        if (!N.allFinite() || (N - N.transpose()).norm() <= symmetric * N.norm()) {
            continue;
        }
        const Square Q = turned_back(N);
        nodes_.push_back(static_cast<std::int32_t>(node));
        transposed_.insert(transposed_.end(), Q.data(), Q.data() + Q.size());
    }
}

Pieces Rotations::turned(const Pieces& D) const {
    Pieces result = D;
    const std::int32_t* dofs = D.dofs.data();
    double* values = result.values.data();
    for (const std::int32_t n : D.sizes) {
        Eigen::Map<Square> piece(values, n, n);
        const Eigen::MatrixXd given = piece;
        for (std::int32_t r = 0; r < n; ++r) {
            const auto found = std::ranges::lower_bound(nodes_, dofs[r] / size_);
            if (found == nodes_.end() || *found != dofs[r] / size_) {
                continue;
            }
            const auto place = static_cast<std::size_t>(found - nodes_.begin());
            const double* row = transposed_.data() + (place * static_cast<std::size_t>(size_) +
                                                      static_cast<std::size_t>(dofs[r] % size_)) *
                                                         static_cast<std::size_t>(size_);
            piece.row(r).setZero();
            for (std::int32_t other = 0; other < n; ++other) {
                if (dofs[other] / size_ == *found) {
                    piece.row(r) += row[dofs[other] % size_] * given.row(other);
                }
            }
        }
        dofs += n;
        values += std::ptrdiff_t{n} * n;
    }
    return result;
}

void Rotations::turn(std::vector<double>& r) const {
    const double* Q = transposed_.data();
    for (const std::int32_t node : nodes_) {
        Eigen::Map<Eigen::VectorXd> here(r.data() + std::ptrdiff_t{node} * size_, size_);
        here = (Eigen::Map<const Square>(Q, size_, size_) * here).eval();
        Q += std::ptrdiff_t{size_} * size_;
    }
}

}  // namespace thermocontact::multigrid

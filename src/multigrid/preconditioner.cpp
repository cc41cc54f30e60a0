#include "multigrid/preconditioner.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

double largest_diagonal(const fem::BlockMatrix& A) {
    const auto size = static_cast<std::size_t>(A.rows);
    double largest = 0;
    for (std::size_t i = 0; i + 1 < A.graph->offsets.size(); ++i) {
        const auto pair = static_cast<std::size_t>(A.graph->offsets[i]);
        for (std::size_t c = 0; c < size; ++c) {
            largest = std::max(largest, std::abs(A.values[(pair * size + c) * size + c]));
        }
    }
    return largest;
}

std::vector<float> added_up_diagonal(const Matrix& A, const SharedNodes& nodes) {
    const std::size_t length = A.block_length();
    std::vector<float> result(nodes.node_count() * length);
    for (std::size_t i = 0; i < nodes.node_count(); ++i) {
        std::copy_n(A.block(static_cast<std::size_t>(A.offsets[i])), length, result.data() + i * length);
    }
    nodes.add_up(result, length);
    return result;
}

using Motions = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Translations along the axes and rotations, at a place.
Motions rigid_motions(const std::array<double, 3>& x, int size) {
    if (size == 1) {
        return Motions::Ones(1, 1);
    }
    if (size == 2) {
        Motions result(2, 3);
        result << 1, 0, -x[1], 0, 1, x[0];
        return result;
    }
    Motions result(3, 6);
    result << 1, 0, 0, 0, x[2], -x[1],  //
        0, 1, 0, -x[2], 0, x[0],        //
        0, 0, 1, x[1], -x[0], 0;
    return result;
}

Eigen::MatrixXd block_at(const std::vector<float>& blocks, std::size_t node, int size) {
    const int stride = lanes(size);
    Eigen::MatrixXd result(size, size);
    for (int c = 0; c < size; ++c) {
        for (int r = 0; r < size; ++r) {
            result(r, c) = blocks[(node * static_cast<std::size_t>(size) + static_cast<std::size_t>(c)) *
                                      static_cast<std::size_t>(stride) +
                                  static_cast<std::size_t>(r)];
        }
    }
    return result;
}

}  // namespace

Preconditioner::Preconditioner(const fem::BlockMatrix& A, const std::vector<char>& fixed,
                               const parallel::Part& part, const parallel::Team& team)
    : A_(&A),
      fixed_(&fixed),
      part_(&part),
      nodes_(part.numbers, team),
      holders_(nodes_.node_count(), 1.0F),
      scale_(team.max(largest_diagonal(A))) {
    if (!(scale_ > 0)) {
        scale_ = 1;
    }
    nodes_.add_up(holders_, 1);
    constant_diagonal_ = added_up_diagonal(fine_matrix(A, {}, fixed, holders_, scale_), nodes_);
}

/// Rigid motions, less where contact holds a node: a coarse level does not see its stiffness, which the
/// smoother deals with at the node, D^-1 D_A B in place of B with D_A the diagonal without contact.
NearNullSpace Preconditioner::motions(const Matrix& fine) const {
    const int size = fine.size;
    const std::vector<float> diagonal = added_up_diagonal(fine, nodes_);
    std::array<double, 3> centre{};
    for (const auto& node : part_->space.nodes) {
        for (std::size_t c = 0; c < node.size() && c < 3; ++c) {
            centre[c] += node[c] / static_cast<double>(part_->space.nodes.size());
        }
    }
    NearNullSpace result{size == 1 ? 1 : size == 2 ? 3 : 6, {}};
    for (std::size_t node = 0; node < nodes_.node_count(); ++node) {
        std::array<double, 3> x{};
        for (std::size_t c = 0; c < static_cast<std::size_t>(size); ++c) {
            x[c] = part_->space.nodes[node][c] - centre[c];
        }
        Motions B = rigid_motions(x, size);
        const Eigen::MatrixXd D = block_at(diagonal, node, size),
                              D_A = block_at(constant_diagonal_, node, size);
        if (D != D_A) {
            const Motions held = D.lu().solve(D_A * B);
            B = held.allFinite() ? held : Motions::Zero(B.rows(), B.cols());
        }
        for (int c = 0; c < size; ++c) {
            if ((*fixed_)[node * static_cast<std::size_t>(size) + static_cast<std::size_t>(c)] != 0) {
                B.row(c).setZero();
            }
        }
        result.values.insert(result.values.end(), B.data(), B.data() + B.size());
    }
    return result;
}

void Preconditioner::renew(const Pieces& D) {
    Matrix fine = fine_matrix(*A_, D, *fixed_, holders_, scale_);
    NearNullSpace near = motions(fine);
    hierarchy_.reset();
    hierarchy_ = std::make_unique<Hierarchy>(std::move(fine), nodes_, std::move(near));
}

void Preconditioner::apply(const std::vector<double>& r, std::vector<double>& z) {
    const auto size = static_cast<std::size_t>(A_->rows), stride = static_cast<std::size_t>(lanes(A_->rows));
    double largest = 0;
    for (const double value : r) {
        largest = std::max(largest, std::abs(value));
    }
    largest = nodes_.team().max(largest);
    if (!(largest > 0) || !std::isfinite(largest)) {
        z = r;
        return;
    }
    std::vector<float>& b = hierarchy_->right_hand_side();
    for (std::size_t dof = 0; dof < r.size(); ++dof) {
        b[dof / size * stride + dof % size] = static_cast<float>(r[dof] / largest);
    }
    hierarchy_->apply();
    const double factor = largest / scale_;
    for (std::size_t dof = 0; dof < z.size(); ++dof) {
        z[dof] = factor * static_cast<double>(hierarchy_->solution()[dof / size * stride + dof % size]);
    }
}

}  // namespace thermocontact::multigrid

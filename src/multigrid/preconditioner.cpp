#include "multigrid/preconditioner.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

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

/// Rotations about it are of the size of the part, wherever this lies.
std::array<double, 3> centre(const std::vector<mesh::Point>& nodes) {
    std::array<double, 3> result{};
    for (const mesh::Point& node : nodes) {
        for (std::size_t c = 0; c < 3; ++c) {
            result[c] += node[c] / static_cast<double>(nodes.size());
        }
    }
    return result;
}

/// L^-1 x of a node.
template <int size>
void divide(const double* inverse, const double* x, double* result) {
    for (int i = 0; i < size; ++i) {
        result[i] = 0;
        for (int k = 0; k <= i; ++k) {
            result[i] += inverse[i * size + k] * x[k];
        }
    }
}

/// L^-T x of a node.
template <int size>
void divide_transposed(const double* inverse, const float* x, double* result) {
    for (int i = 0; i < size; ++i) {
        result[i] = 0;
        for (int k = i; k < size; ++k) {
            result[i] += inverse[k * size + i] * static_cast<double>(x[k]);
        }
    }
}

}  // namespace

Preconditioner::Preconditioner(const fem::BlockMatrix& A, const std::vector<char>& fixed,
                               const parallel::Part& part, const parallel::Team& team)
    : A_(&A),
      fixed_(&fixed),
      part_(&part),
      nodes_(part.numbers, team),
      constant_diagonal_(fine_diagonal(A, {}, fixed, nodes_)) {}

/// Rigid motions B, scaled: L^T B. Where contact holds a node the coarse levels are not to see its stiffness,
/// which the smoother deals with at the node: D^-1 D_A B takes the place of B, D_A being D without contact.
NearNullSpace Preconditioner::motions() const {
    const int size = A_->rows;
    const auto length = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    const std::array<double, 3> middle = centre(part_->space.nodes);
    NearNullSpace result{size == 1 ? 1 : 3 * (size - 1), {}};
    for (std::size_t node = 0; node < nodes_.node_count(); ++node) {
        std::array<double, 3> x = part_->space.nodes[node];
        std::ranges::transform(x, middle, x.begin(), std::minus<>());
        Motions B = rigid_motions(x, size);
        for (int c = 0; c < size; ++c) {
            if ((*fixed_)[node * static_cast<std::size_t>(size) + static_cast<std::size_t>(c)] != 0) {
                B.row(c).setZero();
            }
        }
        scaling_->divide_product(node, constant_diagonal_.data() + node * length, B.data(), result.motions);
        result.values.insert(result.values.end(), B.data(), B.data() + B.size());
    }
    return result;
}

void Preconditioner::renew(const Pieces& D) {
    hierarchy_.reset();
    rotations_ = Rotations(*A_, D, *fixed_, nodes_);
    const Pieces turned = rotations_.turned(D);
    scaling_.emplace(A_->rows, fine_diagonal(*A_, turned, *fixed_, nodes_));
    hierarchy_ = std::make_unique<Hierarchy>(fine_matrix(*A_, turned, *fixed_, *scaling_), nodes_, motions());
}

void Preconditioner::apply(const std::vector<double>& r, std::vector<double>& z) {
    turned_ = r;
    rotations_.turn(turned_);
    with_size(A_->rows, [&]<int size>() {
        double largest = 0;
        for (std::size_t dof = 0; dof < r.size(); dof += size) {
            divide<size>(scaling_->inverse(dof / size), turned_.data() + dof, z.data() + dof);
            for (std::size_t c = 0; c < size; ++c) {
                largest = std::max(largest, std::abs(z[dof + c]));
            }
        }
        largest = nodes_.team().max(largest);
        const double unit = largest > 0 ? largest : 1.0;  // so that single precision holds it
        float* b = hierarchy_->right_hand_side().data();
        for (std::size_t dof = 0; dof < z.size(); dof += size, b += lanes(size)) {
            for (std::size_t c = 0; c < size; ++c) {
                b[c] = static_cast<float>(z[dof + c] / unit);
            }
        }
        hierarchy_->apply();
        const float* x = hierarchy_->solution().data();
        for (std::size_t dof = 0; dof < z.size(); dof += size, x += lanes(size)) {
            divide_transposed<size>(scaling_->inverse(dof / size), x, z.data() + dof);
            for (std::size_t c = 0; c < size; ++c) {
                z[dof + c] *= unit;
            }
        }
    });
}

}  // namespace thermocontact::multigrid

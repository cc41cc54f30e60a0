#include "multigrid/scaling.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

template <int size>
using Block = Eigen::Matrix<double, size, size, size == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
template <int size>
using ConstBlockMap = Eigen::Map<const Block<size>>;

/// L^-1 of D = L L^T.
template <int size>
Block<size> inverse_factor(const Block<size>& D) {
    const Eigen::LLT<Block<size>> factors(D);
    Block<size> result = factors.matrixL().solve(Block<size>::Identity());
    if (factors.info() == Eigen::Success && result.allFinite()) {
        return result;
    }
    const auto own = D.diagonal().array();
    return (own > 0 && own.isFinite()).select(own.rsqrt(), 1.0).matrix().asDiagonal();
}

}  // namespace

Scaling::Scaling(int size, const std::vector<double>& diagonal)
    : size_(size), length_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
    inverses_.resize(diagonal.size());
    with_size(size, [&]<int n>() {
        for (std::size_t first = 0; first < diagonal.size(); first += length_) {
            const ConstBlockMap<n> given(diagonal.data() + first);
            const Block<n> D = (given + given.transpose()) / 2;
            Eigen::Map<Block<n>>(inverses_.data() + first) = inverse_factor<n>(D);
        }
    });
}

void Scaling::scale(std::size_t i, std::size_t j, std::span<double> B) const {
    with_size(size_, [&]<int n>() {
        Eigen::Map<Block<n>> values(B.data());
        values = (ConstBlockMap<n>(inverse(i)) * values * ConstBlockMap<n>(inverse(j)).transpose()).eval();
    });
}

void Scaling::divide_product(std::size_t node, const double* D, double* B, int columns) const {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<Rows> values(B, size_, columns);
    const Eigen::Map<const Rows> inverse_L(inverse(node), size_, size_), block(D, size_, size_);
    values = (inverse_L * (block * values)).eval();
}

}  // namespace thermocontact::multigrid

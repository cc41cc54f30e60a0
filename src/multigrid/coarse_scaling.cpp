#include "multigrid/coarse_scaling.h"

#include "multigrid/blocks.h"
#include "multigrid/scaling.h"

namespace thermocontact::multigrid {
namespace {

/// Blocks of the diagonal, added up; 1 for motions that an aggregate lacks, which have no stiffness and never
/// move.
std::vector<double> coarse_diagonal(const Matrix& A, const NearNullSpace& motions, const SharedNodes& nodes) {
    const auto n = static_cast<std::size_t>(A.size), stride = static_cast<std::size_t>(lanes(A.size));
    std::vector<double> result(nodes.node_count() * n * n);
    for (std::size_t node = 0; node < nodes.node_count(); ++node) {
        const float* block = A.block(static_cast<std::size_t>(A.offsets[node]));
        for (std::size_t r = 0; r < n; ++r) {
            for (std::size_t c = 0; c < n; ++c) {
                result[(node * n + r) * n + c] = block[c * stride + r];
            }
            const bool lacking = nodes.owned(node) && motions.values[(node * n + r) * n + r] == 0;
            result[(node * n + r) * n + r] += lacking ? 1.0 : 0.0;
        }
    }
    nodes.add_up(result, n * n);
    return result;
}

}  // namespace

void scale_coarse(Matrix& A, Prolongation& P, NearNullSpace& motions, const SharedNodes& nodes) {
    const auto n = static_cast<std::size_t>(A.size), stride = static_cast<std::size_t>(lanes(A.size));
    const std::vector<double> diagonal = coarse_diagonal(A, motions, nodes);
    const Scaling scaling(A.size, diagonal);
    std::vector<double> block(n * n);
    for (std::size_t i = 0; i < nodes.node_count(); ++i) {
        const auto last = static_cast<std::size_t>(A.offsets[i + 1]);
        for (auto pair = static_cast<std::size_t>(A.offsets[i]); pair < last; ++pair) {
            float* values = A.block(pair);
            for (std::size_t k = 0; k < n * n; ++k) {
                block[k] = values[k % n * stride + k / n];
            }
            scaling.scale(i, static_cast<std::size_t>(A.columns[pair]), block);
            for (std::size_t k = 0; k < n * n; ++k) {
                values[k % n * stride + k / n] = static_cast<float>(block[k]);
            }
        }
        scaling.divide_product(i, diagonal.data() + i * n * n, motions.values.data() + i * n * n, A.size);
    }
    P.scale(scaling);
}

}  // namespace thermocontact::multigrid

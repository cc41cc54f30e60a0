#include "multigrid/fine_matrix.h"

#include <algorithm>
#include <unordered_map>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

/// Calls visit(i, j, r, c, value) for each entry of the pieces, r and c being components of the nodes i and
/// j.
template <typename Visit>
void visit_entries(const Pieces& D, std::int32_t size, Visit&& visit) {
    const std::int32_t* dofs = D.dofs.data();
    const double* value = D.values.data();
    for (const std::int32_t n : D.sizes) {
        for (std::int32_t r = 0; r < n; ++r) {
            for (std::int32_t c = 0; c < n; ++c, ++value) {
                visit(dofs[r] / size, dofs[c] / size, static_cast<std::size_t>(dofs[r] % size),
                      static_cast<std::size_t>(dofs[c] % size), *value);
            }
        }
        dofs += n;
    }
}

/// The block of A that stands at `pair`, nodes i and j, zero where a dof is fixed.
void copy_free(const fem::BlockMatrix& A, const std::vector<char>& fixed, std::size_t i, std::size_t j,
               std::size_t pair, double* block) {
    const auto size = static_cast<std::size_t>(A.rows);
    for (std::size_t r = 0; r < size; ++r) {
        for (std::size_t c = 0; c < size; ++c) {
            const bool is_free = fixed[i * size + r] == 0 && fixed[j * size + c] == 0;
            block[r * size + c] = is_free ? A.values[(pair * size + r) * size + c] : 0.0;
        }
    }
}

}  // namespace

std::vector<double> fine_diagonal(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                                  const SharedNodes& nodes) {
    const auto size = static_cast<std::size_t>(A.rows), length = size * size;
    std::vector<double> result(nodes.node_count() * length);
    for (std::size_t i = 0; i < nodes.node_count(); ++i) {
        copy_free(A, fixed, i, i, static_cast<std::size_t>(A.graph->offsets[i]), result.data() + i * length);
    }
    visit_entries(D, A.rows, [&](auto i, auto j, auto r, auto c, double value) {
        if (i == j) {
            result[(static_cast<std::size_t>(i) * size + r) * size + c] += value;
        }
    });
    nodes.add_up(result, length);
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] != 0) {
            result[dof * size + dof % size] = 1.0;
        }
    }
    return result;
}

Matrix fine_matrix(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                   const Scaling& scaling) {
    const auto size = static_cast<std::size_t>(A.rows), stride = static_cast<std::size_t>(lanes(A.rows));
    Matrix result{A.rows, A.graph->offsets, A.graph->columns, {}};
    result.values.assign(result.columns.size() * result.block_length(), 0.0F);
    std::unordered_map<std::size_t, std::vector<double>> contact;  // blocks of D, by pair
    visit_entries(D, A.rows, [&](auto i, auto j, auto r, auto c, double value) {
        std::vector<double>& block = contact[i <= j ? result.pair(i, j) : result.pair(j, i)];
        block.resize(size * size, 0.0);
        block[i <= j ? r * size + c : c * size + r] += value / 2;
        if (i == j) {
            block[c * size + r] += value / 2;
        }
    });
    std::vector<double> block(size * size);
    for (std::size_t i = 0; i + 1 < result.offsets.size(); ++i) {
        const auto last = static_cast<std::size_t>(result.offsets[i + 1]);
        for (auto pair = static_cast<std::size_t>(result.offsets[i]); pair < last; ++pair) {
            const auto j = static_cast<std::size_t>(result.columns[pair]);
            copy_free(A, fixed, i, j, pair, block.data());
            if (const auto found = contact.find(pair); found != contact.end()) {
                std::ranges::transform(block, found->second, block.begin(), std::plus<>());
            }
            scaling.scale(i, j, block);
            float* to = result.block(pair);
            for (std::size_t r = 0; r < size; ++r) {
                for (std::size_t c = 0; c < size; ++c) {
                    to[c * stride + r] = static_cast<float>(block[r * size + c]);
                }
            }
        }
    }
    return result;
}

}  // namespace thermocontact::multigrid

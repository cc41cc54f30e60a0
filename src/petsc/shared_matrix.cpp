#include "petsc/shared_matrix.h"

#include <algorithm>

#include "petsc/check.h"
#include "petsc/shared_vectors.h"

namespace thermocontact::petsc {
namespace {

/// The process that owns each global node.
std::int32_t owner(const parallel::NodeNumbers& numbers, std::int32_t global) {
    const auto next = std::ranges::upper_bound(numbers.first, global);
    return static_cast<std::int32_t>(next - numbers.first.begin()) - 1;
}

/// Couplings of the owned nodes with nodes of their own process and of others: exact in the inside of a part;
/// at its border, pairs that several parts have count as often.
struct Couplings {
    std::vector<PetscInt> own, other;
};

Couplings count(const fem::NodeGraph& graph, const parallel::NodeNumbers& numbers) {
    std::vector<double> own(numbers.global.size(), 0.0), other(numbers.global.size(), 0.0);
    for (std::size_t i = 0; i < own.size(); ++i) {
        own[i] += 1;
        for (auto p = graph.offsets[i] + 1; p < graph.offsets[i + 1]; ++p) {
            const auto j = static_cast<std::size_t>(graph.columns[static_cast<std::size_t>(p)]);
            auto& counts =
                owner(numbers, numbers.global[i]) == owner(numbers, numbers.global[j]) ? own : other;
            counts[i] += 1;
            counts[j] += 1;
        }
    }
    SharedVectors nodes(numbers, 1);
    const auto sum = [&](const std::vector<double>& local) {
        const Vector shared = nodes.make();
        nodes.add_up(local, shared);
        const double* values = nullptr;
        check(VecGetArrayRead(shared, &values));
        std::vector<PetscInt> result(values, values + nodes.owned());
        check(VecRestoreArrayRead(shared, &values));
        return result;
    };
    return {sum(own), sum(other)};
}

}  // namespace

Matrix preallocate(const fem::NodeGraph& graph, int block_size, const parallel::NodeNumbers& numbers) {
    const PetscInt size = block_size;
    Couplings couplings = count(graph, numbers);
    const auto owned = static_cast<PetscInt>(couplings.own.size());
    for (PetscInt& bound : couplings.own) {
        bound = std::min(bound, owned);
    }
    for (PetscInt& bound : couplings.other) {
        bound = std::min(bound, numbers.first.back() - owned);
    }
    Matrix result;
    check(MatCreate(PETSC_COMM_WORLD, result.put()));
    check(MatSetSizes(result, owned * size, owned * size, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(result, MATAIJ));
    check(MatSetBlockSize(result, size));
    check(MatXAIJSetPreallocation(result, size, couplings.own.data(), couplings.other.data(), nullptr,
                                  nullptr));
    check(MatSetOption(result, MAT_SPD, PETSC_TRUE));
    return result;
}

void add_values(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                const parallel::NodeNumbers& numbers, Mat result) {
    const fem::NodeGraph& graph = *matrix.graph;
    const auto width = static_cast<std::size_t>(matrix.rows);
    std::vector<double> block(width * width), transposed(width * width);
    for (std::size_t i = 0; i < numbers.global.size(); ++i) {
        for (auto p = graph.offsets[i]; p < graph.offsets[i + 1]; ++p) {
            const auto j = static_cast<std::size_t>(graph.columns[static_cast<std::size_t>(p)]);
            for (std::size_t r = 0; r < width; ++r) {
                for (std::size_t c = 0; c < width; ++c) {
                    const bool kept =
                        (i == j && r == c) || (fixed[i * width + r] == 0 && fixed[j * width + c] == 0);
                    block[r * width + c] =
                        kept ? matrix.values[(static_cast<std::size_t>(p) * width + r) * width + c] : 0.0;
                    transposed[c * width + r] = block[r * width + c];
                }
            }
            const PetscInt row = numbers.global[i], column = numbers.global[j];
            check(MatSetValuesBlocked(result, 1, &row, 1, &column, block.data(), ADD_VALUES));
            if (i != j) {
                check(MatSetValuesBlocked(result, 1, &column, 1, &row, transposed.data(), ADD_VALUES));
            }
        }
    }
}

}  // namespace thermocontact::petsc

#include "fem/both_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "prefetch.h"

namespace thermocontact::fem {
namespace {

template <int rows>
void add_rows(const BothWays& products, NodeRange range, const Target& there, const Target& back) {
    const NodeGraph& graph = *products.matrix->graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    constexpr std::ptrdiff_t pair = std::ptrdiff_t{2} * rows;
    const double* block = products.matrix->values.data() + first * pair;
    const double *x = products.x->data(), *u = products.back_x->data();
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double sum[rows], u_here[rows], back_sum[rows] = {}, own = 0;
        for (int r = 0; r < rows; ++r) {
            sum[r] = block[r] * x[i];
            u_here[r] = products.factor * u[i * rows + r];
            own += block[r] * u_here[r];
        }
        for (++column, block += pair; column < end; ++column, block += pair) {
            prefetch_after<std::size_t{2} * rows>(block);
            const std::ptrdiff_t j = *column;
            double back_there[rows];
#pragma omp simd
            for (int r = 0; r < rows; ++r) {
                sum[r] += block[r] * x[j];
                back_sum[r] += block[rows + r] * u[j * rows + r];
                there.later[j * rows + r] += block[rows + r] * x[i];
                back_there[r] = block[r] * u_here[r];
            }
            for (int r = 0; r < rows; ++r) {
                back.later[j] += back_there[r];
            }
        }
        for (int r = 0; r < rows; ++r) {
            there.here[i * rows + r] += sum[r];
            own += products.factor * back_sum[r];
        }
        back.here[i] += own;
    }
}

/// As a matrix [nodes x 1][nodes x rows] holds those of A^T: the blocks of a pair change places.
std::vector<double> transposed_values(const BlockMatrix& A) {
    const auto rows = static_cast<std::size_t>(A.rows);
    std::vector<double> values = A.values;
    for (std::size_t node = 0; node + 1 < A.graph->offsets.size(); ++node) {
        const auto own = static_cast<std::size_t>(A.graph->offsets[node]),
                   end = static_cast<std::size_t>(A.graph->offsets[node + 1]);
        for (std::size_t pair = own + 1; pair < end; ++pair) {
            const auto block = values.begin() + static_cast<std::ptrdiff_t>(pair * 2 * rows);
            std::swap_ranges(block, block + A.rows, block + A.rows);
        }
    }
    return values;
}

}  // namespace

Pass pass_of(const BothWays& products) {
    return {.results = {Pass::Result{products.y}, Pass::Result{products.back_y}},
            .add = [&products](NodeRange range, const std::array<Target, 2>& results) {
                (products.matrix->rows == 2 ? add_rows<2> : add_rows<3>)(products, range, results[0],
                                                                         results[1]);
                return 0.0;
            }};
}

std::optional<double> factor_of_transposed(const BlockMatrix& A, const BlockMatrix& B) {
    const std::vector<double> expected = transposed_values(A);
    const auto is_smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto largest = std::ranges::max_element(expected, is_smaller);
    if (largest == expected.end() || *largest == 0) {
        return std::nullopt;
    }
    const double factor = B.values[static_cast<std::size_t>(largest - expected.begin())] / *largest;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::abs(factor * *largest);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (!(std::abs(B.values[i] - factor * expected[i]) <= rounding)) {
            return std::nullopt;
        }
    }
    return factor;
}

}  // namespace thermocontact::fem

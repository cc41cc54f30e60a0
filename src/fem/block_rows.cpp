#include "fem/block_rows.h"

#include "prefetch.h"

namespace thermocontact::fem {
namespace {

/// y += A x (transposed: y += A^T x) for one block.
template <int rows, int columns>
inline void add_block(const double* block, const double* x, double* y) {
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            y[r] += block[r * columns + c] * x[c];
        }
    }
}
template <int size>
inline void add_transposed(const double* block, const double* x, double* y) {
    for (int r = 0; r < size; ++r) {
        for (int c = 0; c < size; ++c) {
            y[c] += block[r * size + c] * x[r];
        }
    }
}

template <int size>
void multiply_symmetric(const BlockMatrix& matrix, NodeRange range, double factor, const double* x, double* y,
                        double* later) {
    constexpr std::ptrdiff_t next = std::ptrdiff_t{size} * size;
    const NodeGraph& graph = *matrix.graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    const double* block = matrix.values.data() + first * next;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double here[size], sum[size] = {};
        add_block<size, size>(block, x + i * size, sum);
        for (int c = 0; c < size; ++c) {
            here[c] = factor * x[i * size + c];
        }
        for (++column, block += next; column < end; ++column, block += next) {
            prefetch_after<std::size_t{size} * size>(block);
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * size;
            add_block<size, size>(block, x + j, sum);
            add_transposed<size>(block, here, later + j);
        }
        for (int r = 0; r < size; ++r) {
            y[i * size + r] += factor * sum[r];
        }
    }
}

template <int rows, int columns>
void multiply_pairs(const BlockMatrix& matrix, NodeRange range, double factor, const double* x, double* y,
                    double* later) {
    constexpr std::ptrdiff_t half = std::ptrdiff_t{rows} * columns;
    const NodeGraph& graph = *matrix.graph;
    const double* block =
        matrix.values.data() + graph.offsets[static_cast<std::size_t>(range.begin)] * 2 * half;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        double here[columns], sum[rows] = {};
        for (int c = 0; c < columns; ++c) {
            here[c] = factor * x[i * columns + c];
        }
        for (auto p = graph.offsets[static_cast<std::size_t>(i)];
             p < graph.offsets[static_cast<std::size_t>(i) + 1]; ++p, block += 2 * half) {
            prefetch_after<std::size_t{2} * rows * columns>(block);
            const std::ptrdiff_t j = graph.columns[static_cast<std::size_t>(p)];
            add_block<rows, columns>(block, x + j * columns, sum);
            add_block<rows, columns>(block + half, here, later + j * rows);  // zero where i = j
        }
        for (int r = 0; r < rows; ++r) {
            y[i * rows + r] += factor * sum[r];
        }
    }
}

template <int components>
void multiply_scaled(const BlockMatrix& matrix, NodeRange range, double factor, const double* x, double* y,
                     double* later) {
    const NodeGraph& graph = *matrix.graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    const double* value = matrix.values.data() + first;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double here[components], sum[components] = {};
        for (int c = 0; c < components; ++c) {
            here[c] = factor * x[i * components + c];
            sum[c] = *value * x[i * components + c];
        }
        for (++column, ++value; column < end; ++column, ++value) {
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * components;
            prefetch_after<1>(value);
            for (int c = 0; c < components; ++c) {
                sum[c] += *value * x[j + c];
                later[j + c] += *value * here[c];
            }
        }
        for (int c = 0; c < components; ++c) {
            y[i * components + c] += factor * sum[c];
        }
    }
}

/// sum_i x_i . (A_ii x_i + 2 sum_{j > i} A_ij x_j).
template <int size, bool scaled>
double quadratic(const BlockMatrix& matrix, NodeRange range, const double* x) {
    const NodeGraph& graph = *matrix.graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    const double* block = matrix.values.data() + first * (scaled ? 1 : size * size);
    const auto add = [&](double* sum) {
        const double* values = x + std::ptrdiff_t{*column} * size;
        prefetch_after<scaled ? 1 : std::size_t{size} * size>(block);
        for (int r = 0; r < size; ++r) {
            if constexpr (scaled) {
                sum[r] += *block * values[r];
            } else {
                for (int c = 0; c < size; ++c) {
                    sum[r] += block[r * size + c] * values[c];
                }
            }
        }
        ++column;
        block += scaled ? 1 : size * size;
    };
    double total = 0;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double diagonal[size] = {}, others[size] = {};
        add(diagonal);
        while (column < end) {
            add(others);
        }
        for (int r = 0; r < size; ++r) {
            total += x[i * size + r] * (diagonal[r] + 2 * others[r]);
        }
    }
    return total;
}

}  // namespace

void add_product(const BlockMatrix& matrix, NodeRange range, double factor, const double* x, double* y,
                 double* later) {
    using Multiply = void (*)(const BlockMatrix&, NodeRange, double, const double*, double*, double*);
    constexpr Multiply table[3][3] = {
        {multiply_symmetric<1>, multiply_pairs<1, 2>, multiply_pairs<1, 3>},
        {multiply_pairs<2, 1>, multiply_symmetric<2>, nullptr},
        {multiply_pairs<3, 1>, nullptr, multiply_symmetric<3>},
    };
    constexpr Multiply scaled[3] = {multiply_scaled<1>, multiply_scaled<2>, multiply_scaled<3>};
    (matrix.scaled_identities ? scaled[matrix.rows - 1] : table[matrix.rows - 1][matrix.columns - 1])(
        matrix, range, factor, x, y, later);
}

double quadratic_form(const BlockMatrix& matrix, NodeRange range, const double* x) {
    using Quadratic = double (*)(const BlockMatrix&, NodeRange, const double*);
    constexpr Quadratic table[2][3] = {{quadratic<1, false>, quadratic<2, false>, quadratic<3, false>},
                                       {quadratic<1, true>, quadratic<2, true>, quadratic<3, true>}};
    return table[matrix.scaled_identities ? 1 : 0][matrix.rows - 1](matrix, range, x);
}

}  // namespace thermocontact::fem

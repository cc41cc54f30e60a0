#include "fem/block_rows.h"

#include "prefetch.h"

namespace thermocontact::fem {
namespace {

/// y += A x for one block.
template <int rows, int columns>
inline void add_block(const double* block, const double* x, double* y) {
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            y[r] += block[r * columns + c] * x[c];
        }
    }
}

/// A row's sum A x entry by entry of the blocks: each adds up by itself, so that none waits for the others.
/// On meshes that stay in a cache that wait is what a product takes.
template <int rows, int columns>
struct EntrySums {
    double of[rows * columns] = {};

    void add(const double* block, const double* x) {
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                of[r * columns + c] += block[r * columns + c] * x[c];
            }
        }
    }
    double total(int row) const {
        double sum = 0;
        for (int c = 0; c < columns; ++c) {
            sum += of[row * columns + c];
        }
        return sum;
    }
};

/// y += A^T x for one block.
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
        double here[size];
        EntrySums<size, size> sums;
        sums.add(block, x + i * size);
        for (int c = 0; c < size; ++c) {
            here[c] = factor * x[i * size + c];
        }
        for (++column, block += next; column < end; ++column, block += next) {
            prefetch_after<std::size_t{size} * size>(block);
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * size;
            sums.add(block, x + j);
            add_transposed<size>(block, here, later + j);
        }
        for (int r = 0; r < size; ++r) {
            y[i * size + r] += factor * sums.total(r);
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
        double here[columns];
        EntrySums<rows, columns> sums;
        for (int c = 0; c < columns; ++c) {
            here[c] = factor * x[i * columns + c];
        }
        for (auto p = graph.offsets[static_cast<std::size_t>(i)];
             p < graph.offsets[static_cast<std::size_t>(i) + 1]; ++p, block += 2 * half) {
            prefetch_after<std::size_t{2} * rows * columns>(block);
            const std::ptrdiff_t j = graph.columns[static_cast<std::size_t>(p)];
            sums.add(block, x + j * columns);
            add_block<rows, columns>(block + half, here, later + j * rows);  // zero where i = j
        }
        for (int r = 0; r < rows; ++r) {
            y[i * rows + r] += factor * sums.total(r);
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
        double here[components], sum[components], other[components] = {};
        for (int c = 0; c < components; ++c) {
            here[c] = factor * x[i * components + c];
            sum[c] = *value * x[i * components + c];
        }
        const auto add = [&](double* to) {
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * components;
            prefetch_after<1>(value);
            for (int c = 0; c < components; ++c) {
                to[c] += *value * x[j + c];
                later[j + c] += *value * here[c];
            }
            ++column;
            ++value;
        };
        for (++column, ++value; column + 1 < end;) {  // two sums by turns: neither waits for the other
            add(sum);
            add(other);
        }
        if (column < end) {
            add(sum);
        }
        for (int c = 0; c < components; ++c) {
            y[i * components + c] += factor * (sum[c] + other[c]);
        }
    }
}

/// sum_i x_i . (A_ii x_i + 2 sum_{j > i} A_ij x_j).
template <int size, bool scaled>
double quadratic(const BlockMatrix& matrix, NodeRange range, const double* x) {
    constexpr int entries = scaled ? 1 : size * size;
    const NodeGraph& graph = *matrix.graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    const double* block = matrix.values.data() + first * entries;
    const auto add = [&](EntrySums<size, scaled ? 1 : size>& sums) {
        const double* values = x + std::ptrdiff_t{*column} * size;
        prefetch_after<entries>(block);
        if constexpr (scaled) {
            for (int r = 0; r < size; ++r) {
                sums.of[r] += *block * values[r];
            }
        } else {
            sums.add(block, values);
        }
        ++column;
        block += entries;
    };
    double total = 0;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        EntrySums<size, scaled ? 1 : size> diagonal, even, odd;
        add(diagonal);
        while (column + 1 < end) {
            add(even);
            add(odd);
        }
        if (column < end) {
            add(even);
        }
        for (int r = 0; r < size; ++r) {
            total += x[i * size + r] * (diagonal.total(r) + 2 * (even.total(r) + odd.total(r)));
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

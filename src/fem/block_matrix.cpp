#include "fem/block_matrix.h"

#include <algorithm>
#include <cmath>

#include "prefetch.h"

namespace thermocontact::fem {
namespace {

/// Cells around each node, compressed.
std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> cells_of_nodes(const Dofmap& dofmap) {
    std::vector<std::int32_t> offsets(static_cast<std::size_t>(dofmap.node_count) + 1, 0);
    for (const std::int32_t node : dofmap.cell_nodes) {
        ++offsets[static_cast<std::size_t>(node) + 1];
    }
    for (std::size_t i = 1; i < offsets.size(); ++i) {
        offsets[i] += offsets[i - 1];
    }
    std::vector<std::int32_t> cells(dofmap.cell_nodes.size());
    auto next = offsets;
    for (std::size_t i = 0; i < dofmap.cell_nodes.size(); ++i) {
        const auto node = static_cast<std::size_t>(dofmap.cell_nodes[i]);
        cells[static_cast<std::size_t>(next[node]++)] = static_cast<std::int32_t>(i) / dofmap.nodes_per_cell;
    }
    return {std::move(offsets), std::move(cells)};
}

std::int32_t position(const NodeGraph& graph, std::int32_t row, std::int32_t column) {
    const auto begin = graph.columns.begin() + graph.offsets[static_cast<std::size_t>(row)];
    const auto end = graph.columns.begin() + graph.offsets[static_cast<std::size_t>(row) + 1];
    return static_cast<std::int32_t>(std::lower_bound(begin, end, column) - graph.columns.begin());
}

/// y += A x (transposed: y += A^T x) for one block.
template <int rows, int columns>
inline void add_product(const double* block, const double* x, double* y) {
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
void multiply_symmetric(const BlockMatrix& matrix, const double* x, double* y) {
    constexpr std::ptrdiff_t next = std::ptrdiff_t{size} * size;
    const NodeGraph& graph = *matrix.graph;
    const std::int32_t* column = graph.columns.data();
    const double* block = matrix.values.data();
    for (std::ptrdiff_t i = 0; i < graph.node_count(); ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double here[size], sum[size] = {};
        std::copy_n(x + i * size, size, here);
        add_product<size, size>(block, here, sum);
        for (++column, block += next; column < end; ++column, block += next) {
            prefetch_after<std::size_t{size} * size>(block);
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * size;
            add_product<size, size>(block, x + j, sum);
            add_transposed<size>(block, here, y + j);
        }
        for (int r = 0; r < size; ++r) {
            y[i * size + r] += sum[r];
        }
    }
}

template <int rows, int columns>
void multiply_pairs(const BlockMatrix& matrix, const double* x, double* y) {
    constexpr std::ptrdiff_t half = std::ptrdiff_t{rows} * columns;
    const NodeGraph& graph = *matrix.graph;
    const double* block = matrix.values.data();
    for (std::ptrdiff_t i = 0; i < graph.node_count(); ++i) {
        for (auto p = graph.offsets[static_cast<std::size_t>(i)];
             p < graph.offsets[static_cast<std::size_t>(i) + 1]; ++p, block += 2 * half) {
            prefetch_after<std::size_t{2} * rows * columns>(block);
            const std::ptrdiff_t j = graph.columns[static_cast<std::size_t>(p)];
            add_product<rows, columns>(block, x + j * columns, y + i * rows);
            add_product<rows, columns>(block + half, x + i * columns,
                                       y + j * rows);  // zero where i = j
        }
    }
}

template <int components>
void multiply_scaled(const BlockMatrix& matrix, const double* x, double* y) {
    const NodeGraph& graph = *matrix.graph;
    const std::int32_t* column = graph.columns.data();
    const double* factor = matrix.values.data();
    for (std::ptrdiff_t i = 0; i < graph.node_count(); ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        double here[components], sum[components] = {};
        for (int c = 0; c < components; ++c) {
            here[c] = x[i * components + c];
            sum[c] = *factor * here[c];
        }
        for (++column, ++factor; column < end; ++column, ++factor) {
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * components;
            for (int c = 0; c < components; ++c) {
                sum[c] += *factor * x[j + c];
                y[j + c] += *factor * here[c];
            }
        }
        for (int c = 0; c < components; ++c) {
            y[i * components + c] += sum[c];
        }
    }
}

/// sum_i x_i . (A_ii x_i + 2 sum_{j > i} A_ij x_j).
template <int size, bool scaled>
double quadratic(const BlockMatrix& matrix, const double* x) {
    const NodeGraph& graph = *matrix.graph;
    const std::int32_t* column = graph.columns.data();
    const double* block = matrix.values.data();
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
    for (std::ptrdiff_t i = 0; i < graph.node_count(); ++i) {
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

bool is_scaled_identity(const double* block, std::size_t size) {
    for (std::size_t r = 0; r < size; ++r) {
        for (std::size_t c = 0; c < size; ++c) {
            if (block[r * size + c] != (r == c ? block[0] : 0.0)) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

NodeGraph make_node_graph(const Space& space) {
    const Dofmap& dofmap = space.dofmap;
    const auto [offsets, cells] = cells_of_nodes(dofmap);
    NodeGraph graph;
    graph.offsets.push_back(0);
    std::vector<std::int32_t> neighbours;
    for (std::size_t node = 0; node < static_cast<std::size_t>(dofmap.node_count); ++node) {
        neighbours.clear();
        for (auto i = offsets[node]; i < offsets[node + 1]; ++i) {
            const auto nodes = dofmap.of(cells[static_cast<std::size_t>(i)]);
            neighbours.insert(neighbours.end(), nodes.begin(), nodes.end());
        }
        std::erase_if(neighbours,
                      [&](std::int32_t other) { return other < static_cast<std::int32_t>(node); });
        std::ranges::sort(neighbours);
        const auto repeated = std::unique(neighbours.begin(), neighbours.end());
        graph.columns.insert(graph.columns.end(), neighbours.begin(), repeated);
        graph.offsets.push_back(static_cast<std::int32_t>(graph.columns.size()));
    }
    const auto pairs = static_cast<std::size_t>(dofmap.nodes_per_cell * dofmap.nodes_per_cell);
    graph.cell_positions.reserve(static_cast<std::size_t>(space.cellwise.node_count) * pairs);
    for (std::int32_t cell = 0; cell < space.cellwise.node_count; ++cell) {
        for (const std::int32_t row : dofmap.of(cell)) {
            for (const std::int32_t column : dofmap.of(cell)) {
                graph.cell_positions.push_back(position(graph, std::min(row, column), std::max(row, column)));
            }
        }
    }
    return graph;
}

std::vector<double> BlockMatrix::multiply(const std::vector<double>& x) const {
    std::vector<double> y(static_cast<std::size_t>(graph->node_count() * rows));
    multiply(x, y);
    return y;
}

void BlockMatrix::multiply(const std::vector<double>& x, std::vector<double>& y) const {
    using Multiply = void (*)(const BlockMatrix&, const double*, double*);
    constexpr Multiply table[3][3] = {
        {multiply_symmetric<1>, multiply_pairs<1, 2>, multiply_pairs<1, 3>},
        {multiply_pairs<2, 1>, multiply_symmetric<2>, nullptr},
        {multiply_pairs<3, 1>, nullptr, multiply_symmetric<3>},
    };
    constexpr Multiply scaled[3] = {multiply_scaled<1>, multiply_scaled<2>, multiply_scaled<3>};
    std::ranges::fill(y, 0.0);
    (scaled_identities ? scaled[rows - 1] : table[rows - 1][columns - 1])(*this, x.data(), y.data());
}

double BlockMatrix::quadratic_form(const std::vector<double>& x) const {
    using Quadratic = double (*)(const BlockMatrix&, const double*);
    constexpr Quadratic table[2][3] = {{quadratic<1, false>, quadratic<2, false>, quadratic<3, false>},
                                       {quadratic<1, true>, quadratic<2, true>, quadratic<3, true>}};
    return table[scaled_identities ? 1 : 0][rows - 1](*this, x.data());
}

void BlockMatrix::compress() {
    const auto size = static_cast<std::size_t>(rows), block = size * size;
    for (std::size_t i = 0; i < values.size(); i += block) {
        if (rows != columns || !is_scaled_identity(&values[i], size)) {
            return;
        }
    }
    for (std::size_t i = 0; i * block < values.size(); ++i) {
        values[i] = values[i * block];
    }
    values.resize(values.size() / block);
    values.shrink_to_fit();
    scaled_identities = true;
}

void BlockMatrix::add(double factor, const BlockMatrix& other) {
    if (other.scaled_identities) {
        const auto size = static_cast<std::size_t>(rows), block = size * size;
        for (std::size_t i = 0; i < other.values.size(); ++i) {
            for (std::size_t c = 0; c < size; ++c) {
                values[i * block + c * (size + 1)] += factor * other.values[i];
            }
        }
        return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] += factor * other.values[i];
    }
}

BlockMatrix zero_matrix(const NodeGraph& graph, int rows, int columns) {
    const int block = rows * columns * (rows == columns ? 1 : 2);
    return {&graph, rows, columns,
            std::vector<double>(graph.columns.size() * static_cast<std::size_t>(block), 0.0), false};
}

}  // namespace thermocontact::fem

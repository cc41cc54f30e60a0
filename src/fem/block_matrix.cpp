#include "fem/block_matrix.h"

#include <algorithm>
#include <cmath>

#include "fem/block_rows.h"

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
    std::ranges::fill(y, 0.0);
    add_product(*this, {0, graph->node_count()}, 1.0, x.data(), y.data(), y.data());
}

double BlockMatrix::quadratic_form(const std::vector<double>& x) const {
    return fem::quadratic_form(*this, {0, graph->node_count()}, x.data());
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

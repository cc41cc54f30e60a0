#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fem/block_matrix.h"

namespace thermocontact::fem {
namespace {

void scatter(std::span<const double> tensor, std::span<const std::int32_t> nodes, int components,
             std::vector<double>& vector) {
    const auto size = static_cast<std::size_t>(components);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t c = 0; c < size; ++c) {
            vector[static_cast<std::size_t>(nodes[i]) * size + c] += tensor[i * size + c];
        }
    }
}

/// Square operators are stored by half: a form that is not symmetric must not pass for its upper triangle.
void require_symmetry(std::span<const double> tensor, std::size_t size, const std::string& form) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            largest = std::max(largest, std::abs(tensor[i * size + j]));
            difference = std::max(difference, std::abs(tensor[i * size + j] - tensor[j * size + i]));
        }
    }
    if (difference > 1e-10 * largest) {  // round-off of the kernel's sums is far below
        throw std::logic_error("form " + form + " is not symmetric");
    }
}

/// Adds a cell's tensor [node, row][node, column] to the matrix; `positions` are the cell's.
template <int rows, int columns>
void add_pairs(const double* tensor, std::span<const std::int32_t> nodes, const std::int32_t* positions,
               BlockMatrix& matrix) {
    constexpr bool symmetric = rows == columns;
    constexpr std::ptrdiff_t block = rows * columns;
    const auto width = static_cast<std::ptrdiff_t>(nodes.size()) * columns;
    for (std::size_t i = 0; i < nodes.size(); ++i, tensor += rows * width) {
        for (std::size_t j = 0; j < nodes.size(); ++j, ++positions) {
            const bool lower = nodes[j] < nodes[i];
            if (symmetric && lower) {
                continue;
            }
            const std::ptrdiff_t place =
                symmetric ? *positions : 2 * std::ptrdiff_t{*positions} + (lower ? 1 : 0);
            double* values = matrix.values.data() + place * block;
            const double* from = tensor + static_cast<std::ptrdiff_t>(j) * columns;
            for (int a = 0; a < rows; ++a) {
                for (int b = 0; b < columns; ++b) {
                    values[a * columns + b] += from[a * width + b];
                }
            }
        }
    }
}

/// Adds `count` tensors to the matrix: tabulate(i, tensor) adds the i-th, which belongs to the cell
/// cell_of(i).
template <typename CellOf, typename Tabulate>
void assemble(std::size_t count, CellOf cell_of, Tabulate tabulate, const std::string& form,
              const Space& space, BlockMatrix& matrix) {
    using Add = void (*)(const double*, std::span<const std::int32_t>, const std::int32_t*, BlockMatrix&);
    constexpr Add table[3][3] = {{add_pairs<1, 1>, add_pairs<1, 2>, add_pairs<1, 3>},
                                 {add_pairs<2, 1>, add_pairs<2, 2>, nullptr},
                                 {add_pairs<3, 1>, nullptr, add_pairs<3, 3>}};
    const Add add = table[matrix.rows - 1][matrix.columns - 1];
    const auto n = static_cast<std::size_t>(space.dofmap.nodes_per_cell);
    std::vector<double> tensor(n * n * static_cast<std::size_t>(matrix.rows * matrix.columns));
    for (std::size_t i = 0; i < count; ++i) {
        std::ranges::fill(tensor, 0.0);
        tabulate(i, std::span<double>(tensor));
        if (matrix.symmetric() && i == 0) {
            require_symmetry(tensor, n * static_cast<std::size_t>(matrix.rows), form);
        }
        const std::int32_t cell = cell_of(i);
        const auto positions = static_cast<std::size_t>(cell) * n * n;
        add(tensor.data(), space.dofmap.of(cell), matrix.graph->cell_positions.data() + positions, matrix);
    }
}

}  // namespace

BlockMatrix assemble_matrix(Form form, const Space& space, const NodeGraph& graph, int rows, int columns) {
    BlockMatrix matrix = zero_matrix(graph, rows, columns);
    const auto number = [](std::size_t i) { return static_cast<std::int32_t>(i); };
    assemble(
        static_cast<std::size_t>(space.cellwise.node_count), number,
        [&](std::size_t i, std::span<double> tensor) { form.add_cell(number(i), tensor); }, form.name(),
        space, matrix);
    return matrix;
}

void assemble_facets(Form& form, std::span<const mesh::Facet> facets, const Space& space,
                     BlockMatrix& matrix) {
    assemble(
        facets.size(), [&](std::size_t i) { return facets[i].cell; },
        [&](std::size_t i, std::span<double> tensor) { form.add_facet(facets[i], tensor); }, form.name(),
        space, matrix);
}

void assemble_cells(Form& form, const Dofmap& dofmap, int components, std::vector<double>& vector) {
    std::vector<std::int32_t> all(dofmap.cell_nodes.size() / static_cast<std::size_t>(dofmap.nodes_per_cell));
    std::iota(all.begin(), all.end(), 0);
    assemble_cells(form, all, dofmap, components, vector);
}

void assemble_cells(Form& form, std::span<const std::int32_t> cells, const Dofmap& dofmap, int components,
                    std::vector<double>& vector) {
    std::vector<double> tensor(static_cast<std::size_t>(dofmap.nodes_per_cell * components));
    for (const std::int32_t cell : cells) {
        std::ranges::fill(tensor, 0.0);
        form.add_cell(cell, tensor);
        scatter(tensor, dofmap.of(cell), components, vector);
    }
}

void assemble_facets(Form& form, std::span<const mesh::Facet> facets, const Dofmap& dofmap, int components,
                     std::vector<double>& vector) {
    std::vector<double> tensor(static_cast<std::size_t>(dofmap.nodes_per_cell * components));
    for (const mesh::Facet& facet : facets) {
        std::ranges::fill(tensor, 0.0);
        form.add_facet(facet, tensor);
        scatter(tensor, dofmap.of(facet.cell), components, vector);
    }
}

double integrate(Form& form, std::span<const mesh::Facet> facets) {
    double sum = 0.0;
    for (const mesh::Facet& facet : facets) {
        form.add_facet(facet, {&sum, 1});
    }
    return sum;
}

}  // namespace thermocontact::fem

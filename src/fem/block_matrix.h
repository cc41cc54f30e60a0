/// Sparse matrices over the nodes of a space, with a small dense block for each pair of coupled nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/form.h"
#include "fem/space.h"

namespace thermocontact::fem {

/// Which nodes couple: for each node those of its neighbours that are not before it, itself first, in order.
/// Shared by all matrices of a space.
struct NodeGraph {
    std::vector<std::int32_t> offsets;  ///< [nodes + 1]
    std::vector<std::int32_t> columns;  ///< [offsets.back()]
    std::vector<std::int32_t>
        cell_positions;  ///< [cells][row node][column node]: of the pair, whatever its order

    std::int32_t node_count() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
};

NodeGraph make_node_graph(const Space& space);

/// y = A x with A [nodes x rows][nodes x columns], blocks row-major at the positions of the graph. Square
/// ones are symmetric and hold the upper triangle; others hold for each pair i <= j the block (i, j) and then
/// (j, i).
struct BlockMatrix {
    const NodeGraph* graph;
    int rows;     ///< components of y at a node
    int columns;  ///< components of x at a node
    std::vector<double> values;
    bool scaled_identities = false;  ///< each block is a multiple of the identity, `values` holds its factor

    bool symmetric() const { return rows == columns; }

    std::vector<double> multiply(const std::vector<double>& x) const;

    /// y = A x without allocating; y has its size already.
    void multiply(const std::vector<double>& x, std::vector<double>& y) const;

    /// x^T A x of a symmetric matrix: half the work of a product.
    double quadratic_form(const std::vector<double>& x) const;

    /// Keeps the factors only if every block is a multiple of the identity (mass matrices); does nothing
    /// otherwise.
    void compress();

    /// this += factor * other (same shape; this is not compressed).
    void add(double factor, const BlockMatrix& other);
};

BlockMatrix zero_matrix(const NodeGraph& graph, int rows, int columns);

/// Sum over all cells of the form's tensors [node, row][node, column]. Throws std::logic_error for a square
/// form that is not symmetric.
BlockMatrix assemble_matrix(Form form, const Space& space, const NodeGraph& graph, int rows, int columns);

/// Adds the form's tensors [node, row][node, column] of the facets to the matrix. Throws as above.
void assemble_facets(Form& form, std::span<const mesh::Facet> facets, const Space& space,
                     BlockMatrix& matrix);

/// Adds the form's tensors [node, component] of all cells to `vector`.
void assemble_cells(Form& form, const Dofmap& dofmap, int components, std::vector<double>& vector);

/// The same of the listed cells only.
void assemble_cells(Form& form, std::span<const std::int32_t> cells, const Dofmap& dofmap, int components,
                    std::vector<double>& vector);

/// Adds the form's tensors [node, component] of the facets to `vector`.
void assemble_facets(Form& form, std::span<const mesh::Facet> facets, const Dofmap& dofmap, int components,
                     std::vector<double>& vector);

/// Integral of a scalar form over the facets.
double integrate(Form& form, std::span<const mesh::Facet> facets);

}  // namespace thermocontact::fem

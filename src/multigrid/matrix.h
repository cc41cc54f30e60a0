/// The matrix of a level: symmetric, its upper triangle by blocks. Of several processes each holds a part;
/// the parts add up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/block_matrix.h"

namespace thermocontact::multigrid {

struct Matrix {
    int size = 1;                       ///< unknowns of a node
    std::vector<std::int32_t> offsets;  ///< [nodes + 1]
    std::vector<std::int32_t> columns;  ///< of each node: itself, then those after it that couple, in order
    std::vector<float> values;          ///< [pairs][size][lanes(size)], see blocks.h

    std::int32_t node_count() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    std::size_t block_length() const;
    float* block(std::size_t pair) { return values.data() + pair * block_length(); }
    const float* block(std::size_t pair) const { return values.data() + pair * block_length(); }

    /// Where the block of nodes i <= j stands. Throws std::logic_error if they do not couple.
    std::size_t pair(std::int32_t i, std::int32_t j) const;

    /// y = A x of this part; padded nodal vectors.
    void multiply(const std::vector<float>& x, std::vector<float>& y) const;
};

/// Pieces of another matrix: dense ones on some dofs each, row-major.
struct Pieces {
    std::vector<std::int32_t> sizes, dofs;
    std::vector<double> values;
};

/// (A + (D + D^T) / 2) / scale without rows and columns of `fixed` dofs, which hold nothing but 1 / `holders`
/// of their node on the diagonal: what the processes that hold it add up to 1. D is the sum of the pieces.
Matrix fine_matrix(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                   const std::vector<float>& holders, double scale);

}  // namespace thermocontact::multigrid

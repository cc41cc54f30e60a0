/// Products with a few rows of a matrix.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/block_matrix.h"

namespace thermocontact::fem {

class MatrixRows {
  public:
    /// A copy of the rows of the listed dofs, of a symmetric matrix that is not compressed.
    MatrixRows(const BlockMatrix& matrix, std::span<const std::int32_t> dofs);

    /// y := A x at the dofs of the rows; y is left as it is elsewhere.
    void multiply(const std::vector<double>& x, std::vector<double>& y) const;

  private:
    std::vector<std::int32_t> dofs_;
    std::vector<std::size_t> offsets_;   ///< [dofs + 1]
    std::vector<std::int32_t> columns_;  ///< [offsets.back()]
    std::vector<double> values_;         ///< likewise
};

}  // namespace thermocontact::fem

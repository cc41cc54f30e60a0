/// The supernodes of a sparse Cholesky factor, as CHOLMOD finds them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/cholmod.h"
#include "solve/symmetric_matrix.h"

namespace thermocontact::solve {

/// Thrown where no Cholesky factor exists; `row` is a row of the matrix in which that shows.
struct NotPositiveDefinite {
    std::int32_t row;
};

/// Columns with the same rows below their triangle.
struct Supernode {
    std::int32_t first, columns;         ///< of L
    std::span<const std::int32_t> rows;  ///< ascending, the columns' own first

    /// Those below the triangle.
    std::span<const std::int32_t> below() const { return rows.subspan(static_cast<std::size_t>(columns)); }
};

class Supernodes {
  public:
    /// Of a matrix whose order keeps fill low; its last `tail` rows stay last as a set. The rows of a column
    /// need not be sorted. Throws std::bad_alloc.
    Supernodes(const SymmetricMatrix& matrix, std::int32_t tail);

    /// order()[i]: row of the matrix that is i-th in the factor, a postorder of the elimination tree.
    std::span<const std::int32_t> order() const;

    std::size_t count() const { return factor_->nsuper; }
    Supernode operator[](std::size_t number) const;

  private:
    CholmodCommon common_;
    FactorPointer factor_;
};

}  // namespace thermocontact::solve

/// A sparse Cholesky factor by supernodes, as CHOLMOD computes it.
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
    const double* numbers;               ///< [columns][rows]

    const double* column(std::int32_t c) const {
        return numbers + static_cast<std::ptrdiff_t>(c) * static_cast<std::ptrdiff_t>(rows.size());
    }
};

class Supernodes {
  public:
    /// Factors A with the fill-reducing `order`, whose last `tail` rows stay last as a set. Throws
    /// NotPositiveDefinite, or std::bad_alloc.
    Supernodes(const SymmetricMatrix& matrix, std::span<const std::int32_t> order, std::int32_t tail);

    /// order()[i]: row of A that is i-th in the factor.
    std::span<const std::int32_t> order() const;

    std::size_t count() const { return factor_->nsuper; }
    Supernode operator[](std::size_t number) const;

  private:
    void require_pivots(const SymmetricMatrix& matrix) const;

    CholmodCommon common_;
    FactorPointer factor_;
};

}  // namespace thermocontact::solve

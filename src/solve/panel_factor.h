/// A sparse Cholesky factor stored for streaming: the triangular solves read each number of L once, in order.
///
/// CHOLMOD computes L; its own solves call BLAS on many small panels and reach a third of the memory
/// bandwidth. Here the columns of each supernode lie in groups of four without the rows above the diagonal,
/// one after another.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "solve/huge_pages.h"

namespace thermocontact::solve {

/// A symmetric matrix, lower triangle by compressed columns with sorted rows.
struct SymmetricMatrix {
    std::int32_t size;
    std::vector<std::int32_t> offsets;
    std::vector<std::int32_t> rows;
    std::vector<double> values;
};

/// Thrown where no Cholesky factor exists; `row` is a row of the matrix in which that shows.
struct NotPositiveDefinite {
    std::int32_t row;
};

class PanelFactor {
  public:
    /// Factors A with the fill-reducing `order` (order[i] = row of A that comes i-th); the last `tail` rows
    /// of the order stay last as a set, and couple densely. Throws NotPositiveDefinite, or std::bad_alloc.
    PanelFactor(const SymmetricMatrix& matrix, std::span<const std::int32_t> order, std::int32_t tail);

    /// order()[i]: row of A that is i-th in the factor (`order` refined).
    const std::vector<std::int32_t>& order() const { return order_; }

    /// x := L_ii^-1 x_i on the head; the tail becomes x_t - L_ti x_i, the right-hand side of the Schur
    /// complement.
    void forward(std::vector<double>& x);

    /// Head of x := L_ii^-T (x_i - L_ti^T x_t), given the tail.
    void backward(std::vector<double>& x);

    /// L_tt L_tt^T, the Schur complement of the tail (dense, symmetric) [tail][tail].
    Eigen::MatrixXd schur_complement() const;

    /// Numbers stored for L.
    std::int64_t entries() const { return static_cast<std::int64_t>(values_.size()); }

  private:
    struct Panel {
        std::int32_t first_column, columns, rows;
        std::int64_t values;  ///< start in values_
        std::int64_t below;   ///< start in rows_ of the rows below the diagonal block
    };

    void store(const double* supernode, std::int32_t leading, std::int32_t first, std::int32_t columns,
               std::span<const std::int32_t> rows);

    std::int32_t size_, head_;
    std::vector<std::int32_t> order_;
    std::vector<Panel> panels_;  ///< of the head
    HugeVector<double> values_;
    std::vector<std::int32_t> rows_;
    Eigen::MatrixXd tail_;        ///< L_tt
    std::vector<double> buffer_;  ///< one panel's rows of the vector
};

/// Orders the nodes of an undirected graph (lower triangle by compressed columns) by nested dissection
/// (METIS).
std::vector<std::int32_t> nested_dissection(const SymmetricMatrix& graph);

}  // namespace thermocontact::solve

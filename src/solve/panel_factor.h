/// A sparse Cholesky factor stored for streaming: the triangular solves read each number of L once, in order.
///
/// L is computed by fronts (fronts.h), whose columns are stored at once. Solves that call BLAS on many small
/// panels, as CHOLMOD's, reach a third of the memory bandwidth; here the columns of each supernode lie in
/// groups of four (column_group.h), one after another. Columns of equal fronts (equal_fronts.h) are stored,
/// and read from memory, once.
///
/// Supernodes of a large factor are sorted into branches of the elimination tree, which threads go through
/// at the same time, and the trunk, which couples these. The order of all sums is that of the branches, so
/// that the last bit does not depend on how many threads there are.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solve/branches.h"
#include "solve/column_group.h"
#include "solve/fronts.h"
#include "solve/huge_pages.h"
#include "solve/supernodes.h"
#include "solve/symmetric_matrix.h"
#include "solve/workers.h"

namespace thermocontact::solve {

/// Numbers in a factor that is worth threads: a pass through less takes about as long as waking them.
constexpr std::int64_t worth_threads = 500'000;

class PanelFactor {
  public:
    /// Factors A, whose rows come in an order that keeps fill low (those of a column need not be sorted); its
    /// last `tail` rows stay last as a set, and couple densely. With less than `smallest_cut` numbers there
    /// is one branch only. The head is stored as `storage` says, the tail in double precision. Throws
    /// NotPositiveDefinite, or std::bad_alloc.
    PanelFactor(const SymmetricMatrix& matrix, std::int32_t tail, std::shared_ptr<Workers> workers,
                Storage storage = Storage::doubles, std::int64_t smallest_cut = worth_threads);

    /// order()[i]: row of A that is i-th in the factor (A's own order refined).
    const std::vector<std::int32_t>& order() const { return order_; }

    /// x := L_ii^-1 x_i on the head; the tail becomes x_t - L_ti x_i, the right-hand side of the Schur
    /// complement.
    void forward(std::vector<double>& x);

    /// Head of x := L_ii^-T (x_i - L_ti^T x_t), given the tail.
    void backward(std::vector<double>& x);

    /// L_tt L_tt^T, the Schur complement of the tail (dense, symmetric) [tail][tail].
    Eigen::MatrixXd schur_complement() const;

    /// Numbers in L, the zeros that fill up groups among them.
    std::int64_t entries() const { return entries_; }
    /// What they take, equal columns once.
    std::int64_t bytes() const { return all_bytes_; }

  private:
    struct Panel {
        std::int32_t first_column, columns, rows;
        std::int64_t bytes;  ///< start in bytes_
        std::int64_t below;  ///< start in rows_ of the rows below the diagonal block
    };
    struct Branch {
        std::size_t begin, end;       ///< of panels_
        std::int32_t rows;            ///< those below this are the branch's own, or its descendants'
        std::vector<double> buffer;   ///< one panel's rows of the vector
        std::vector<double> outside;  ///< what its panels add to the rows from there on
    };

    struct Making;
    Branch lay_out(Making& making, std::span<const std::int32_t> chosen, std::int32_t end);
    void make(Making& making, std::span<const std::int32_t> chosen, const fem::Beside& beside);
    void make_numbers(Making& making, const Branches& cuts);
    void store_tail(const Making& making, std::size_t number, const double* numbers);
    void forward(const Panel& panel, Branch& branch, std::vector<double>& x) const;
    void backward(const Panel& panel, Branch& branch, std::vector<double>& x) const;

    std::int32_t size_, head_;
    Storage storage_;
    std::shared_ptr<Workers> workers_;
    std::vector<std::int32_t> order_;
    std::vector<Panel> panels_;  ///< of the head: by branch, then the trunk
    std::int64_t entries_ = 0;
    std::int64_t all_bytes_ = 0;
    HugeVector<std::byte> bytes_;
    std::vector<std::int32_t> rows_;
    std::vector<Branch> branches_;
    Branch trunk_{};
    Eigen::MatrixXd tail_;  ///< L_tt
};

/// Orders the nodes of an undirected graph (lower triangle by compressed columns) by nested dissection
/// (METIS).
std::vector<std::int32_t> nested_dissection(const SymmetricMatrix& graph);

}  // namespace thermocontact::solve

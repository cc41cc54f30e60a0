/// Sparse Cholesky factorisation by fronts (J. W. H. Liu, The multifrontal method, SIAM Review 34, 1992).
///
/// A supernode's front is the dense symmetric matrix over its rows: the matrix's entries in its columns and
/// what its children in the elimination tree leave. Eliminating the columns gives those of L, and leaves an
/// update over the rows below, which is added to the parent's front. Each supernode needs only its children:
/// subtrees are independent. All sums have one order, whatever runs beside what.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/traversal.h"
#include "solve/supernodes.h"
#include "solve/symmetric_matrix.h"

namespace thermocontact::solve {

class Fronts {
  public:
    /// What one thread works in.
    struct Workspace {
        std::vector<std::int32_t> local;  ///< [rows of the factor]: where in the front at hand
        std::vector<double> panel;        ///< of that front [columns][rows]
        std::vector<double> diagonal;     ///< [columns]: of the matrix
    };

    /// What they refer to must stay.
    Fronts(const SymmetricMatrix& matrix, const Supernodes& supernodes);

    /// The supernode's columns of L [columns][rows], in the workspace; above the diagonal they hold anything.
    /// Its children must have been factored. Large fronts are shared by what runs `beside`. Throws
    /// NotPositiveDefinite with a row of the matrix, or std::bad_alloc.
    const double* factor(std::size_t number, Workspace& work, const fem::Beside& beside);

  private:
    void assemble(std::size_t number, Workspace& work);
    void add_matrix(const Supernode& supernode, Workspace& work) const;
    void add_update(std::size_t child, const Supernode& supernode, const Workspace& work, double* panel,
                    double* update) const;

    const SymmetricMatrix* matrix_;
    const Supernodes* supernodes_;
    std::vector<std::int32_t> place_;                 ///< [rows of the matrix]: in the factor
    std::vector<std::vector<std::size_t>> children_;  ///< [supernodes], ascending
    std::vector<std::vector<double>> updates_;        ///< [supernodes]: lower triangle [below][below]
};

}  // namespace thermocontact::solve

/// Sparse Cholesky factorisation by fronts (J. W. H. Liu, The multifrontal method, SIAM Review 34, 1992).
///
/// A supernode's front is the dense symmetric matrix over its rows: the matrix's entries in its columns and
/// what its children in the elimination tree leave. Eliminating the columns gives those of L, and leaves an
/// update over the rows below, which is added to the parent's front. Each supernode needs only its children:
/// subtrees are independent. All sums have one order, whatever runs beside what. Of equal fronts
/// (equal_fronts.h) the first one alone is made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/traversal.h"
#include "solve/front_tree.h"

namespace thermocontact::solve {

class Fronts {
  public:
    /// What one thread works in.
    struct Workspace {
        std::vector<std::int32_t> local;   ///< [rows of the factor]: where in the front at hand
        std::vector<double> panel;         ///< of that front [columns][rows]
        std::vector<double> diagonal;      ///< [columns]: of the matrix
        std::vector<std::int32_t> places;  ///< of a child's rows in that front
    };

    /// `first` [supernodes]: the first one whose front is equal. What they refer to must stay.
    Fronts(const FrontTree& tree, std::span<const std::int32_t> first);

    /// The supernode's columns of L [columns][rows], in the workspace; above the diagonal they hold anything.
    /// Each supernode that is the first one is factored once, after the first ones of its children. Large
    /// fronts are shared by what runs `beside`. Throws NotPositiveDefinite with a row of the matrix, or
    /// std::bad_alloc.
    const double* factor(std::size_t number, Workspace& work, const fem::Beside& beside);

  private:
    void assemble(std::size_t number, Workspace& work);
    void add_matrix(std::size_t number, Workspace& work) const;
    void add_update(std::size_t child, const Supernode& supernode, Workspace& work, double* update) const;
    void release(std::size_t child);

    const FrontTree* tree_;
    std::span<const std::int32_t> first_;
    std::vector<std::int32_t> uses_;            ///< [supernodes]: of the update, by what is to be factored
    std::vector<std::vector<double>> updates_;  ///< [supernodes]: lower triangle [below][below]
};

}  // namespace thermocontact::solve

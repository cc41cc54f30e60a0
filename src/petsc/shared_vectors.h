/// Nodal vectors of a part, and the vectors that all processes share.
#pragma once

#include <vector>

#include "parallel/part.h"
#include "petsc/objects.h"

namespace thermocontact::petsc {

class SharedVectors {
  public:
    /// Keeps a reference to `numbers`.
    SharedVectors(const parallel::NodeNumbers& numbers, int components);

    /// A shared vector, zero.
    Vector make() const;

    /// Adds up what the processes hold at shared nodes; `local` [nodes][components].
    void add_up(const std::vector<double>& local, Vec shared);

    /// The values of the nodes that this process owns.
    void put(const std::vector<double>& local, Vec shared) const;

    /// The values at all nodes of the part.
    void take(Vec shared, std::vector<double>& local);

    int components() const { return components_; }

    /// The place of a dof of the part among all, and among the owned (-1: another process owns it).
    PetscInt global_index(std::size_t dof) const;
    PetscInt owned_index(std::size_t dof) const;

    PetscInt owned() const { return owned_; }  ///< entries of this process
    PetscInt begin() const { return begin_; }  ///< the first of them

  private:
    const parallel::NodeNumbers* numbers_;
    int components_;
    PetscInt owned_, begin_;
    bool whole_;    ///< the part is all there is, in order
    Vector shape_;  ///< a shared vector to duplicate
    Vector local_;  ///< wraps the arrays given
    Scatter scatter_;
};

}  // namespace thermocontact::petsc

/// The matrix that all processes share, from what each assembled on its part.
#pragma once

#include "parallel/part.h"
#include "petsc/objects.h"
#include "solve/step_problem.h"

namespace thermocontact::petsc {

/// An empty matrix with room for the couplings of all parts' graphs. Throws SystemError.
Matrix preallocate(const fem::NodeGraph& graph, int block_size, const parallel::NodeNumbers& numbers);

/// Adds this part's entries; rows and columns of fixed dofs get their diagonal entry only. To be followed by
/// MatAssemblyBegin and MatAssemblyEnd. Throws SystemError.
void add_values(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                const parallel::NodeNumbers& numbers, Mat result);

}  // namespace thermocontact::petsc

/// The matrix that all processes share, from what each assembled on its part.
#pragma once

#include "parallel/part.h"
#include "petsc/objects.h"
#include "solve/step_problem.h"

namespace thermocontact::petsc {

/// Rows and columns of fixed dofs hold their diagonal entry only. Throws SystemError.
Matrix assemble(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                const parallel::NodeNumbers& numbers);

}  // namespace thermocontact::petsc

/// The derivative A + dF/dx of a step's equation, applied without being assembled over the processes.
///
/// Each process multiplies what it holds of A, of which it stores the upper triangle by blocks, and the dense
/// pieces of its contact facets; what several hold of a shared node adds up. An assembled matrix would
/// take 2.7 times the memory, and a product is bound by how fast that is read.
#pragma once

#include <span>
#include <vector>

#include "multigrid/fine_matrix.h"
#include "parallel/part.h"
#include "petsc/objects.h"
#include "petsc/shared_vectors.h"
#include "solve/step_problem.h"

namespace thermocontact::petsc {

class Tangent {
  public:
    /// `matrix` and `fixed` [dofs] as in StepProblemInput; all arguments must outlive the object. Rows and
    /// columns of fixed dofs hold their diagonal entry only. Throws SystemError.
    Tangent(const fem::BlockMatrix& matrix, const std::vector<char>& fixed, SharedVectors& vectors);
    Tangent(const Tangent&) = delete;
    Tangent& operator=(const Tangent&) = delete;

    /// Takes dF/dx at x, whose entries are the `dofs` of the part, in the place of the one there was.
    void set_derivative(solve::NonlinearTerm& F, const Eigen::VectorXd& x,
                        const std::vector<std::int32_t>& dofs);
    void drop_derivative();

    /// dF/dx becomes its transpose, as does the matrix that the shell multiplies by: A is symmetric.
    void transpose();

    /// The matrix as PETSc's solvers take it: it can be multiplied, and tells its diagonal.
    Mat shell() const { return shell_; }

    /// dF/dx: dense pieces on dofs of the part.
    const multigrid::Pieces& derivative() const { return derivative_; }

    /// y += |dF/dx| x, both [dofs].
    void add_derivative_magnitudes(const std::vector<double>& x, std::vector<double>& y) const;

    /// y = A x over the dofs that are not fixed, zero at those; `x` [dofs] with zeros at the fixed ones.
    void multiply_constant(const std::vector<double>& x, Vec y);

    /// Sets the entries of fixed dofs to zero.
    void zero_fixed(Vec shared) const;

  private:
    static PetscErrorCode multiply(Mat shell, Vec x, Vec y);
    static PetscErrorCode get_diagonal(Mat shell, Vec diagonal);
    void apply(Vec x, Vec y);
    void put_diagonal(Vec diagonal);
    void add_derivative(const std::vector<double>& x, std::vector<double>& y) const;
    void zero_fixed(std::vector<double>& values) const;

    const fem::BlockMatrix* matrix_;
    SharedVectors* vectors_;
    std::vector<std::int32_t> fixed_dofs_;
    std::vector<PetscInt> owned_fixed_;  ///< among the owned
    std::vector<double> fixed_diagonal_;
    multigrid::Pieces derivative_;
    std::vector<double> local_x_, local_y_;
    Matrix shell_;
};

}  // namespace thermocontact::petsc

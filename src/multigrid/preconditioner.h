/// A preconditioner for the tangent A + dF/dx of a step's equation, of which A stays and dF/dx changes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "multigrid/fine_matrix.h"
#include "multigrid/hierarchy.h"
#include "multigrid/rotations.h"
#include "multigrid/scaling.h"
#include "parallel/part.h"

namespace thermocontact::multigrid {

class Preconditioner {
  public:
    /// `A` and `fixed` [dofs] are those of the part. All arguments must outlive the object. Every process
    /// must call.
    Preconditioner(const fem::BlockMatrix& A, const std::vector<char>& fixed, const parallel::Part& part,
                   const parallel::Team& team);

    /// A new hierarchy, for A and `D` = dF/dx. Every process must call.
    void renew(const Pieces& D);

    /// z = M^-1 r; both [dofs], the same at shared nodes wherever these are held. Every process must call.
    void apply(const std::vector<double>& r, std::vector<double>& z);

  private:
    NearNullSpace motions() const;

    const fem::BlockMatrix* A_;
    const std::vector<char>* fixed_;
    const parallel::Part* part_;
    SharedNodes nodes_;
    std::vector<double> constant_diagonal_;  ///< [nodes][size][size], of A alone
    Rotations rotations_;
    std::optional<Scaling> scaling_;
    std::unique_ptr<Hierarchy> hierarchy_;
    std::vector<double> turned_;  ///< of apply()
};

}  // namespace thermocontact::multigrid

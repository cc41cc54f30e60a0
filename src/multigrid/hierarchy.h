/// Smoothed aggregation multigrid as a preconditioner: one symmetric V-cycle in single precision.
#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <vector>

#include "multigrid/level.h"
#include "multigrid/tentative.h"

namespace thermocontact::multigrid {

class Hierarchy {
  public:
    /// `motions` [nodes]: the near-null space of `fine`. Every process must call.
    Hierarchy(Matrix fine, SharedNodes nodes, NearNullSpace motions);

    /// The right-hand side of apply(), consistent, and what it finds: padded nodal vectors.
    std::vector<float>& right_hand_side() { return levels_.front()->b; }
    const std::vector<float>& solution() const { return levels_.front()->x; }

    /// Every process must call.
    void apply() { cycle(0); }

  private:
    void factor_coarsest();
    void solve_coarsest();
    void cycle(std::size_t number);

    std::vector<std::unique_ptr<Level>> levels_;  ///< from fine to coarse
    bool dense_ = false;                          ///< the coarsest is solved, otherwise smoothed
    Eigen::LDLT<Eigen::MatrixXd> coarsest_;
};

}  // namespace thermocontact::multigrid

/// Broyden's method on top of a derivative that is kept: each step taken with it says what it should have
/// been, and improves the next ones (C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, 7.3:
/// "good" updates, of which the steps are all that must be known). A few products of vectors an iteration.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermocontact::solve {

/// What is added to the unknowns x, and S times that (newton.h).
struct NewtonUpdate {
    Eigen::VectorXd step, linear;
};

class Secants {
  public:
    /// The next update, from -B^-1 r with the derivative B that is kept and the residual r.
    NewtonUpdate improved(NewtonUpdate update) const;

    /// That such an update was taken, to the residual that the next one starts from.
    void take(NewtonUpdate update) { taken_.push_back(std::move(update)); }

    /// Of another derivative, or a shortened step.
    void forget() { taken_.clear(); }

  private:
    std::vector<NewtonUpdate> taken_;
};

}  // namespace thermocontact::solve

/// Broyden's method on top of a derivative that is kept: each step taken with it says what it should have
/// been, and improves the next ones (C. T. Kelley, Iterative Methods for Linear and Nonlinear Equations, 7.3:
/// "good" updates, of which the steps are all that must be known). A few products of vectors an iteration.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermocontact::solve {

class Secants {
  public:
    /// The next step, from -B^-1 r with the derivative B that is kept and the residual r.
    Eigen::VectorXd improved(Eigen::VectorXd step) const;

    /// That such a step was taken, to the residual that the next one starts from.
    void take(Eigen::VectorXd step) { steps_.push_back(std::move(step)); }

    /// Of another derivative, or a shortened step.
    void forget() { steps_.clear(); }

  private:
    std::vector<Eigen::VectorXd> steps_;
};

}  // namespace thermocontact::solve

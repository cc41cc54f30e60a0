/// Continuation in the friction regularisation: where Newton fails for a small epsilon, the step is solved
/// for a large one, which is tightened rung by rung, each solve starting from the last (MODEL.md, 5).
#pragma once

#include <functional>

#include "solve/newton.h"

namespace thermocontact::solve {

struct ContinuationResult {
    NewtonResult newton;  ///< of the last rung tried; iterations of all of them
    int rungs;            ///< solves made
};

/// `solve(floor, x)` solves with every regularisation raised to at least `floor`, from x. The ladder starts
/// at `start` from the value in x, and each rung is a tenth of the one before; a rung that fails is tried
/// again closer to the last. Converged only at floor = target; else the end of the last rung that failed, or
/// not_reached after 200 rungs.
ContinuationResult continue_regularisation(
    const std::function<NewtonResult(double floor, Eigen::VectorXd& x)>& solve, double start, double target,
    Eigen::VectorXd& x);

}  // namespace thermocontact::solve

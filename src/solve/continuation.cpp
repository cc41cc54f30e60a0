#include "solve/continuation.h"

#include <algorithm>
#include <cmath>

namespace thermocontact::solve {
namespace {

constexpr double tightening = 0.1;        ///< from rung to rung
constexpr double least_tightening = 0.9;  ///< a rung that fails at this one ends the ladder
constexpr int most_rungs = 200;

}  // namespace

ContinuationResult continue_regularisation(
    const std::function<NewtonResult(double floor, Eigen::VectorXd& x)>& solve, double start, double target,
    Eigen::VectorXd& x) {
    double floor = std::max(start, target);
    double factor = tightening;
    double solved = 0;  // the rung that x solves; none yet
    int iterations = 0;
    for (int rung = 1;; ++rung) {
        Eigen::VectorXd attempt = x;
        NewtonResult result = solve(floor, attempt);
        iterations += result.iterations;
        result.iterations = iterations;
        if (result.end == NewtonEnd::converged) {
            x = std::move(attempt);
            if (floor <= target) {
                return {result, rung};
            }
            solved = floor;
        } else if (solved == 0 || factor >= least_tightening) {
            return {result, rung};
        } else {
            factor = std::sqrt(factor);
        }
        if (rung == most_rungs) {
            // what the last rung solves is another problem than the one asked for
            result.end = NewtonEnd::not_reached;
            return {result, rung};
        }
        floor = std::max(solved * factor, target);
    }
}

}  // namespace thermocontact::solve

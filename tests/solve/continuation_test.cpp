// A ladder of regularisations that is too long.

#include "solve/continuation.h"

#include <gtest/gtest.h>

namespace thermocontact::solve {
namespace {

/// Every rung at half of the last one succeeds, those at a tenth do not, and the target is 180 halvings away:
/// the rungs end before it. What the last one solves is another problem than the one asked for.
TEST(Continuation, HalfWayIsNoSolution) {
    double last = 1e46;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
    const ContinuationResult result = continue_regularisation(
        [&](double floor, Eigen::VectorXd& value) {
            if (floor < 0.5 * last) {
                return NewtonResult{NewtonEnd::line_search_failed, 1, 0.5};
            }
            value[0] = last = floor;
            return NewtonResult{NewtonEnd::converged, 1, 1e-13};
        },
        last, 1e-8, x);
    EXPECT_GT(last, 1e-8) << "the target was reached: the case tests nothing";
    EXPECT_EQ(result.newton.end, NewtonEnd::not_reached);
}

}  // namespace
}  // namespace thermocontact::solve

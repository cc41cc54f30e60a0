#include "solve/condensed_problem.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

/// The capacity matrix of a square, its lower side in contact, the rest free or fixed.
class OneBalance : public testing::Test {
  protected:
    const support::Discretisation at{"mesh.cells = [3, 2]\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n"};
    const fem::BlockMatrix matrix = fem::assemble_matrix(
        {fem::find_kernel("heat_capacity.capacity", "triangle", 1), at.mesh, {{"c", {1.0}}}}, at.space,
        at.graph, 1, 1);
    std::vector<char> contact = std::vector<char>(at.node_count(), 0);
    std::vector<char> fixed = contact;
    Condensed strategy{InteriorOrders(at.graph)};

    OneBalance() {
        for (std::size_t node = 0; node < at.node_count(); ++node) {
            contact[node] = at.space.nodes[node][1] == 0.0 ? 1 : 0;
        }
    }
    std::unique_ptr<StepProblem> problem() {
        return strategy.prepare({"heat", matrix, fixed, contact, true, {1e-12, 50}});
    }
};

/// A bound of what friction meets counts magnitudes, of the start value and of the solution without contact.
TEST_F(OneBalance, LargestUnknownCountsMagnitudes) {
    const auto one = problem();
    const std::vector<double> nothing(at.node_count(), 0.0), start(at.node_count(), -7.0);
    EXPECT_EQ(one->largest_unknown(one->begin(nothing, start)), 7.0);
    const std::vector<double> rhs = matrix.multiply(std::vector<double>(at.node_count(), -9.0));
    EXPECT_NEAR(one->largest_unknown(one->begin(rhs, start)), 9.0, 1e-12);
}

/// The other nodes are fixed, so that nothing turns infinity into another value that is no number.
TEST_F(OneBalance, ASolutionIsFinite) {
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        fixed[node] = contact[node] == 0 ? 1 : 0;
    }
    const auto one = problem();
    std::vector<double> solution(at.node_count(), 0.0);
    Eigen::VectorXd x = one->begin(solution, solution);
    EXPECT_TRUE(one->finish(x, solution));
    for (const double wrong :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        x[1] = wrong;
        EXPECT_FALSE(one->finish(x, solution)) << wrong;
    }
}

}  // namespace
}  // namespace thermocontact::solve

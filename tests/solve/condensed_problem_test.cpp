#include "solve/condensed_problem.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

/// Springs at the contact unknowns.
class Springs : public NonlinearTerm {
  public:
    explicit Springs(double stiffness) : stiffness_(stiffness) {}
    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override { value = stiffness_ * x; }
    void visit_derivative(const Eigen::VectorXd& x, const Piece& visit) override {
        for (std::int32_t i = 0; i < x.size(); ++i) {
            visit(std::span(&i, 1), std::span(&stiffness_, 1));
        }
    }

  private:
    double stiffness_;
};

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
    Condensed in_words{InteriorOrders(at.graph), Storage::words};

    OneBalance() {
        for (std::size_t node = 0; node < at.node_count(); ++node) {
            contact[node] = at.space.nodes[node][1] == 0.0 ? 1 : 0;
        }
    }
    std::unique_ptr<StepProblem> problem() { return problem(strategy, matrix); }
    std::unique_ptr<StepProblem> problem(Strategy& by, const fem::BlockMatrix& A) {
        return by.prepare({"heat", A, fixed, contact, true, {1e-12, 50}});
    }
    /// A solution from a start value, with springs at the contact unknowns.
    std::vector<double> solve(StepProblem& one, const std::vector<double>& rhs, std::vector<double> solution);
};

/// A bound of what friction meets counts magnitudes, of the start value and of the solution without contact.
TEST_F(OneBalance, LargestUnknownCountsMagnitudes) {
    const auto one = problem();
    const std::vector<double> nothing(at.node_count(), 0.0), start(at.node_count(), -7.0);
    EXPECT_EQ(one->largest_unknown(one->begin(nothing, start)), 7.0);
    const std::vector<double> rhs = matrix.multiply(std::vector<double>(at.node_count(), -9.0));
    EXPECT_NEAR(one->largest_unknown(one->begin(rhs, start)), 9.0, 1e-12);
}

std::vector<double> OneBalance::solve(StepProblem& one, const std::vector<double>& rhs,
                                      std::vector<double> solution) {
    Springs springs(0.3);
    Eigen::VectorXd x = one.begin(rhs, solution);
    EXPECT_EQ(one.solve(springs, x).end, NewtonEnd::converged);
    EXPECT_TRUE(one.finish(x, solution));
    EXPECT_EQ(one.refine(springs, x, solution).end, NewtonEnd::converged);
    return solution;
}

/// From any start value, and with fixed unknowns that have a value: what is left of the words is a backward
/// error of 1e-12 (condensed_problem.cpp), times the condition of a capacity matrix, which is below 20.
TEST_F(OneBalance, AFactorInWordsGivesTheSolutionOfDoubles) {
    fixed[at.node_count() - 1] = 1;
    const auto one = problem(), other = problem(in_words, matrix);
    EXPECT_TRUE(in_words.starts_matter());
    EXPECT_FALSE(strategy.starts_matter());
    const std::vector<double> rhs = matrix.multiply(support::random_numbers(at.node_count()));
    const std::vector<double> exact = solve(*one, rhs, std::vector<double>(at.node_count(), 3.0));
    const double close = 2 * 20 * 1e-12 * support::as_vector(exact).cwiseAbs().maxCoeff();
    for (const double from : {0.0, 3.0, -1e3}) {
        std::vector<double> start(at.node_count(), from);
        start.back() = 3;
        const std::vector<double> found = solve(*other, rhs, start);
        EXPECT_EQ(found.back(), 3);
        EXPECT_LE((support::as_vector(found) - support::as_vector(exact)).cwiseAbs().maxCoeff(), close)
            << from;
    }
    const int corrections = other->factor_use().corrections;
    EXPECT_GE(corrections, 3) << "words alone were enough";
    EXPECT_TRUE(other->factor_use().single);
    EXPECT_EQ(solve(*other, rhs, std::vector<double>(at.node_count(), 0.0)),
              solve(*other, rhs, std::vector<double>(at.node_count(), 0.0)))
        << "a solve leaves a trace";
    const int before = other->factor_use().corrections;
    solve(*other, rhs, exact);
    EXPECT_EQ(other->factor_use().corrections, before) << "a start value at the solution needs one pass";
}

/// A factor in words contracts wherever doubles can factor (refinement.h). Here it is one of half the matrix:
/// corrections take nothing off.
TEST_F(OneBalance, AFactorThatIsTooCoarseMakesWayForDoubles) {
    fem::BlockMatrix A = matrix;
    const auto one = problem(in_words, A);
    EXPECT_FALSE(one->kept_derivative()) << "nothing is known before the first step";
    for (double& value : A.values) {
        value *= 2;
    }
    const std::vector<double> rhs = support::random_numbers(at.node_count(), 3);
    const std::vector<double> start(at.node_count(), 0.0);
    const Eigen::VectorXd expected = support::as_vector(solve(*problem(strategy, A), rhs, start));
    const auto expect_solved = [&](const std::vector<double>& solution) {
        EXPECT_LE((support::as_vector(solution) - expected).norm(), 1e-12 * expected.norm());
    };
    expect_solved(solve(*one, rhs, start));
    EXPECT_TRUE(one->factor_use().too_coarse);
    EXPECT_FALSE(one->factor_use().single);
    const int corrections = one->factor_use().corrections;
    expect_solved(solve(*one, rhs, start));
    EXPECT_EQ(one->factor_use().corrections, corrections) << "doubles need no corrections";

    const auto kept = one->kept_derivative();
    ASSERT_TRUE(kept);
    EXPECT_TRUE(kept->in_doubles);
    const auto resumed = problem(in_words, A);
    resumed->take_up(*kept);
    EXPECT_TRUE(resumed->factor_use().too_coarse) << "a restart goes on with doubles";
    expect_solved(solve(*resumed, rhs, start));

    const auto other = problem(in_words, A);
    expect_solved(solve(*other, rhs, start));
    EXPECT_TRUE(other->factor_use().single) << "that of the matrix itself is not too coarse";
}

/// cond(T, x) over all unknowns, contact and others, from the condensed factors: within Hager's factor of 3
/// of the dense one.
TEST_F(OneBalance, ConditionIsThatOfTheWholeSystem) {
    fixed[at.node_count() - 1] = 1;
    const auto one = problem();
    const std::vector<double> rhs = matrix.multiply(support::random_numbers(at.node_count()));
    std::vector<double> solution(at.node_count(), 0.0);
    Eigen::VectorXd x = one->begin(rhs, solution);
    EXPECT_FALSE(one->condition(rhs)) << "nothing is factored yet";
    Springs springs(0.3);
    ASSERT_EQ(one->solve(springs, x).end, NewtonEnd::converged);
    ASSERT_TRUE(one->finish(x, solution));
    const auto condition = one->condition(solution);
    ASSERT_TRUE(condition);

    Eigen::MatrixXd T = support::dense(matrix);
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        const auto i = static_cast<Eigen::Index>(node);
        T(i, i) += contact[node] != 0 ? 0.3 : 0.0;
    }
    const Eigen::Index free = T.rows() - 1;
    const Eigen::VectorXd full = support::as_vector(solution), g = T.cwiseAbs() * full.cwiseAbs();
    const Eigen::MatrixXd inverse = T.topLeftCorner(free, free).inverse();
    const Eigen::VectorXd bounds = inverse.cwiseAbs() * g.head(free);
    const double exact = bounds.maxCoeff() / full.head(free).cwiseAbs().maxCoeff();
    EXPECT_LE(condition->system, exact * (1 + 1e-9));
    EXPECT_GE(condition->system, exact * (1 - 1e-9))
        << "the estimate is exact where it finds the largest row";
    EXPECT_GE(condition->contact, 1);
    EXPECT_LT(condition->contact, condition->system);
    solution[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(one->condition(solution));
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

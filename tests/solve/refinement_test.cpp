#include "solve/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

void in_turn(int count, const std::function<void(int)>& task) {
    for (int number = 0; number < count; ++number) {
        task(number);
    }
}

/// The capacity matrix of a square, one node fixed.
class OneDefect : public testing::Test {
  protected:
    const support::Discretisation at{"mesh.cells = [3, 2]\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n"};
    const fem::BlockMatrix matrix = fem::assemble_matrix(
        {fem::find_kernel("heat_capacity.capacity", "triangle", 1), at.mesh, {{"c", {1.0}}}}, at.space,
        at.graph, 1, 1);
    std::vector<char> fixed = std::vector<char>(at.node_count(), 0);
    std::vector<double> w = support::random_numbers(at.node_count());
    const std::vector<double> nothing = std::vector<double>(at.node_count(), 0.0);

    OneDefect() { fixed[5] = 1; }

    double diagonal(std::size_t i) const {
        return support::dense(matrix)(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    }
};

TEST_F(OneDefect, IsTheRightHandSideLessAWAtTheUnknowns) {
    Defect defect(matrix, fixed, in_turn);
    const std::vector<double> rhs = support::random_numbers(at.node_count(), 7);
    defect.take(rhs, w);
    w[5] = 0;
    const Eigen::VectorXd expected = support::as_vector(rhs) - support::dense(matrix) * support::as_vector(w);
    EXPECT_LE((support::as_vector(defect.value()) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

/// The smallest omega for which a matrix within omega (a_ii a_jj)^(1/2) and a right-hand side within omega
/// |b| are solved: here with b = 0 in the row at fault.
TEST_F(OneDefect, BackwardErrorIsRelativeToTheDiagonal) {
    Defect defect(matrix, fixed, in_turn);
    w[5] = 0;
    std::vector<double> rhs = matrix.multiply(w);
    const double rounding = 8 * std::numeric_limits<double>::epsilon();  // of rows with at most 8 terms
    defect.take(rhs, w);
    EXPECT_LE(defect.backward_error(rhs, w, {}, {}), rounding);
    double size = 0;
    for (std::size_t j = 0; j < w.size(); ++j) {
        size = std::max(size, std::sqrt(diagonal(j)) * std::abs(w[j]));
    }
    const double before = rhs[2];
    rhs[2] += 1e-3;
    defect.take(rhs, w);
    const double expected = 1e-3 / (std::sqrt(diagonal(2)) * size + std::abs(rhs[2]));
    EXPECT_NEAR(defect.backward_error(rhs, w, {}, {}), expected, 1e-12 * expected);
    const std::vector<std::int32_t> dofs{2};
    const std::vector<double> forces{rhs[2] - before}, value = defect.value();
    EXPECT_LE(defect.backward_error(rhs, w, dofs, forces), 1e-15) << "forces bear it";
    EXPECT_EQ(defect.value(), value) << "forces are no part of the defect";
    rhs[2] = before;
    rhs[5] += 1;
    defect.take(rhs, w);
    EXPECT_LE(defect.backward_error(rhs, w, {}, {}), rounding) << "a fixed row counts";
}

/// Of unknowns in other units: rows and columns of A, entries of w and b scaled.
TEST_F(OneDefect, BackwardErrorKnowsNoUnits) {
    Defect defect(matrix, fixed, in_turn);
    const std::vector<double> rhs = support::random_numbers(at.node_count(), 7);
    defect.take(rhs, w);
    const double expected = defect.backward_error(rhs, w, {}, {});
    fem::BlockMatrix scaled = matrix;
    const auto unit = [](std::size_t i) { return i % 2 == 0 ? 1024.0 : 1.0; };
    for (std::size_t i = 0; i < at.node_count(); ++i) {
        for (auto p = static_cast<std::size_t>(at.graph.offsets[i]);
             p < static_cast<std::size_t>(at.graph.offsets[i + 1]); ++p) {
            scaled.values[p] *= unit(i) * unit(static_cast<std::size_t>(at.graph.columns[p]));
        }
    }
    std::vector<double> scaled_rhs = rhs, scaled_w = w;
    for (std::size_t i = 0; i < w.size(); ++i) {
        scaled_rhs[i] *= unit(i);
        scaled_w[i] /= unit(i);
    }
    Defect other(scaled, fixed, in_turn);
    other.take(scaled_rhs, scaled_w);
    EXPECT_DOUBLE_EQ(other.backward_error(scaled_rhs, scaled_w, {}, {}), expected);
}

TEST_F(OneDefect, WhatIsNotFiniteIsNoSolution) {
    Defect defect(matrix, fixed, in_turn);
    w[2] = std::numeric_limits<double>::quiet_NaN();
    defect.take(nothing, w);
    EXPECT_EQ(defect.backward_error(nothing, w, {}, {}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace thermocontact::solve

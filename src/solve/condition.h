/// How many digits a linear system leaves, estimated from factors that exist.
///
/// Data and arithmetic round each entry of T x = b by a share u of itself, at least, and to first order the
/// solution then changes by at most u |T^-1| |T| |x|, entry by entry: Skeel's condition number
///
///   cond(T, x) = || |T^-1| |T| |x| ||_inf / ||x||_inf
///
/// times u bounds the relative error (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 7.2).
/// Scaled rows leave it as it is, scaled columns as far as they leave the largest entry of x where it is:
/// contact 1e14 times as stiff as the body costs no digit, as long as some entry of x is not contact's alone.
/// The Cholesky factorisation does no more harm than that: its backward error is a multiple of u
/// (a_ii a_jj)^(1/2) in each entry, as small as the entries that a diagonal scaling to 1 makes (10.1 there).
///
/// With g = |T| |x| the norm in question is || T^-1 diag(g) ||_inf = || diag(g) T^-T ||_1, which Hager's and
/// Higham's method (15.3 there, LAPACK's xLACN2) bounds from below, mostly to within a factor of 3, by a few
/// products: solves with T and its transpose.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "fem/block_matrix.h"

namespace thermocontact::solve {

/// Of one system; 1 is the best there is.
struct Condition {
    double system;                  ///< of A + dF/dx over all unknowns
    std::optional<double> contact;  ///< of S + dF/dx over the contact unknowns, where S is known; 1: none
};

/// Decimal digits that a condition number leaves of a double's: -log10(epsilon condition), not below 0.
double digits_left(double condition);

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// A lower bound of ||B||_1 from a few products with B and its transpose, n x n.
double estimate_norm_1(Eigen::Index n, const LinearMap& apply, const LinearMap& apply_transposed);

/// cond(T, x) with g = |T| |x|; 1 for x = 0. Infinite where a solve is not finite.
double skeel_condition(const LinearMap& solve, const LinearMap& solve_transposed, const Eigen::VectorXd& g,
                       const Eigen::VectorXd& x);

/// |A| |x|, [dofs].
std::vector<double> product_of_magnitudes(const fem::BlockMatrix& matrix, const std::vector<double>& x);

}  // namespace thermocontact::solve

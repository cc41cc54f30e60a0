/// The largest quotient (B v, v) / (A v, v) of two quadratic forms: what the constants of inequalities are.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace thermocontact::theory {

/// y := the product with x; both have their size.
using Product = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;

/// A symmetric positive definite and B symmetric positive semidefinite, by what they do to vectors of `size`.
struct Quotient {
    Eigen::Index size;
    Product numerator;    ///< B x
    Product denominator;  ///< A x
    Product solve;        ///< A^-1 x
};

/// An eigenvalue mu and the relative residual |A^-1 B v - mu v|_A / (mu |v|_A) of its vector, which bounds
/// the relative error of mu.
struct Eigenvalue {
    double value;
    double residual;
};

/// The greatest residual that largest_quotient() accepts. It iterates to 1e-10, but round-off leaves that of
/// A^-1, 1e-16 times the condition of A: slender bodies need the margin.
constexpr double greatest_residual = 1e-4;

/// The largest eigenvalue of B v = mu A v, by restarted Lanczos; 0 where B is. Throws NumericsError if the
/// residual is too large.
Eigenvalue largest_quotient(const Quotient& quotient);

}  // namespace thermocontact::theory

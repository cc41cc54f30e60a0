#include "theory/largest_quotient.h"

#include <Spectra/SymGEigsSolver.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "number.h"

namespace thermocontact::theory {
namespace {

using Vector = Eigen::VectorXd;
using In = Eigen::Map<const Vector>;
using Out = Eigen::Map<Vector>;

/// B / scale in the words of Spectra.
struct Numerator {
    using Scalar = double;
    const Quotient* quotient;
    double scale;

    Eigen::Index rows() const { return quotient->size; }
    void perform_op(const double* x, double* y) const {
        Vector result(rows());
        quotient->numerator(In(x, rows()), result);
        Out(y, rows()) = result / scale;
    }
};

/// A likewise.
struct Denominator {
    using Scalar = double;
    const Quotient* quotient;

    Eigen::Index rows() const { return quotient->size; }
    void perform_op(const double* x, double* y) const { apply(quotient->denominator, x, y); }
    void solve(const double* x, double* y) const { apply(quotient->solve, x, y); }

  private:
    void apply(const Product& product, const double* x, double* y) const {
        Vector result(rows());
        product(In(x, rows()), result);
        Out(y, rows()) = result;
    }
};

/// (B v, v) / (A v, v).
double value(const Quotient& quotient, const Vector& v) {
    Vector Bv(v.size()), Av(v.size());
    quotient.numerator(v, Bv);
    quotient.denominator(v, Av);
    return Bv.dot(v) / Av.dot(v);
}

/// |A^-1 B v - mu v|_A / (mu |v|_A).
double relative_residual(const Quotient& quotient, const Vector& v, double mu) {
    Vector Bv(v.size()), r(v.size()), Ar(v.size()), Av(v.size());
    quotient.numerator(v, Bv);
    quotient.solve(Bv, r);
    r -= mu * v;
    quotient.denominator(r, Ar);
    quotient.denominator(v, Av);
    return std::sqrt(std::max(0.0, Ar.dot(r)) / Av.dot(v)) / mu;
}

/// One step of the power method on a vector without structure: zero only if B is.
Vector first_guess(const Quotient& quotient) {
    Spectra::SimpleRandom<double> random(0);
    Vector Bx(quotient.size), v(quotient.size);
    quotient.numerator(random.random_vec(quotient.size), Bx);
    quotient.solve(Bx, v);
    return v;
}

constexpr double tolerance = 1e-10;

/// Whether the first guess is an eigenvector already, as where B is of rank 1: from there Lanczos' method has
/// no direction to go but round-off. As the guess holds a part of each eigenvector, no larger value is left
/// out.
bool is_eigenvector(const Quotient& quotient, const Vector& start) {
    return quotient.size == 1 || relative_residual(quotient, start, value(quotient, start)) <= tolerance;
}

Vector eigenvector(const Quotient& quotient, const Vector& start, double scale) {
    constexpr Eigen::Index wanted = 1, largest_subspace = 24, restarts = 1000;
    Numerator numerator{&quotient, scale};
    Denominator denominator{&quotient};
    Spectra::SymGEigsSolver<Numerator, Denominator, Spectra::GEigsMode::RegularInverse> solver(
        numerator, denominator, wanted, std::min(quotient.size, largest_subspace));
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, restarts, tolerance);
    if (solver.info() != Spectra::CompInfo::Successful) {
        throw NumericsError("an eigenvalue of the theory's constants did not converge in " +
                            std::to_string(restarts) + " restarts");
    }
    return solver.eigenvectors();
}

}  // namespace

Eigenvalue largest_quotient(const Quotient& quotient) {
    if (quotient.size == 0) {
        return {0, 0};
    }
    const Vector start = first_guess(quotient);
    if (start.isZero(0)) {
        return {0, 0};
    }
    // the test of convergence is partly absolute: scaled, the eigenvalue is of the order of 1
    const double scale = value(quotient, start);
    const Vector v = is_eigenvector(quotient, start) ? start : eigenvector(quotient, start, scale);
    const double mu = value(quotient, v), residual = relative_residual(quotient, v, mu);
    if (!(residual <= greatest_residual)) {
        throw NumericsError("an eigenvalue of the theory's constants has the relative residual " +
                            short_text(residual) + ", above " + short_text(greatest_residual) +
                            ": the body is too slender, or the mesh too uneven");
    }
    return {mu, residual};
}

}  // namespace thermocontact::theory

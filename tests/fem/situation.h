/// Numbers and fields on one triangle, and what closed forms of kernels there are made of.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fem/form.h"
#include "support/barycentric.h"

namespace thermocontact::fem {

using support::Polynomial;
using support::Triangle;
using support::Vector2;
using support::VectorPolynomial;

/// Numbers and fields on one triangle. Contact is the same kind (open or closed, ...) on the whole of each
/// facet.
struct Situation {
    std::string name;
    Triangle triangle;
    int degree;
    Constants constants;
    VectorPolynomial u, w, f;
    Polynomial g, theta, theta_F;
    std::vector<double> stress;              ///< xx, yy, zz, xy, yz, xz
    std::array<VectorPolynomial, 2> G = {};  ///< recovered gradients of the two components of a vector field
    VectorPolynomial H = {};                 ///< that of the temperature
    bool closed = true;
    double transfer_slope = 0;  ///< k_c(r) = transfer_offset + transfer_slope r
    double transfer_offset = 0;
    double limited_slope = 1;  ///< phi_L(s) = limited_offset + limited_slope s
    double limited_offset = 0;
    Vector2 multiplier{12, -9};      ///< of Coulomb's law, the same everywhere
    Vector2 foundation{0.1, -0.25};  ///< v_F, the same everywhere
    bool held = false;               ///< |multiplier + gamma w_t| < mu p_n on all facets; else greater

    double constant(const std::string& name) const { return constants.at(name).front(); }
    std::vector<Polynomial> shapes() const { return support::shape_functions(degree); }
};

/// One shape function of the vector space.
struct VectorShape {
    Polynomial value;
    std::size_t component;
    VectorPolynomial gradient;

    Polynomial dot(const Vector2& vector) const { return value * vector[component]; }
    /// Voigt strain (e_xx, e_yy, 2 e_xy).
    std::array<Polynomial, 3> strain() const {
        return component == 0 ? std::array<Polynomial, 3>{gradient[0], 0.0, gradient[1]}
                              : std::array<Polynomial, 3>{0.0, gradient[1], gradient[0]};
    }
};

inline std::vector<VectorShape> vector_shapes(const Situation& at) {
    std::vector<VectorShape> result;
    for (const Polynomial& shape : at.shapes()) {
        for (std::size_t c = 0; c < 2; ++c) {
            result.push_back({shape, c, at.triangle.gradient(shape)});
        }
    }
    return result;
}

/// Entries entry(row, column) for all pairs of the two lists.
template <typename Rows, typename Columns, typename Entry>
std::vector<Polynomial> outer(const Rows& rows, const Columns& columns, Entry entry) {
    std::vector<Polynomial> result;
    for (const auto& row : rows) {
        for (const auto& column : columns) {
            result.push_back(entry(row, column));
        }
    }
    return result;
}

template <typename Rows, typename Entry>
std::vector<Polynomial> each(const Rows& rows, Entry entry) {
    std::vector<Polynomial> result;
    for (const auto& row : rows) {
        result.push_back(entry(row));
    }
    return result;
}

inline Polynomial dot(const VectorPolynomial& a, const Vector2& b) {
    return a[0] * b[0] + a[1] * b[1];
}

inline std::vector<Polynomial> vector_load(const Situation& at) {
    return each(vector_shapes(at), [&](const auto& v) { return v.value * at.f[v.component]; });
}

inline std::vector<Polynomial> scalar_load(const Situation& at, const Polynomial& q) {
    return each(at.shapes(), [&](const auto& v) { return v * q; });
}

/// The contact quantities of one facet.
struct Contact {
    Vector2 n;
    Polynomial r;          ///< u.n - g
    Polynomial p, dp;      ///< p_n(r), p_n'(r)
    Vector2 w_t;           ///< over the foundation
    double speed;          ///< |w_t|_eps
    double tangent[2][2];  ///< I - n n^T

    Contact(const Situation& at, std::size_t facet)
        : n(at.triangle.outward_normal(facet)), r(dot(at.u, n) - at.g) {
        const double c_n = at.constant("c_n"), m = at.constant("m"), eps = at.constant("eps");
        if (at.closed) {
            p = m == 1 ? c_n * r : c_n * r * r;
            dp = m == 1 ? Polynomial(c_n) : 2 * c_n * r;
        }
        const std::array<double, 3> anywhere{1, 0, 0};  // w is constant
        const Vector2 w{at.w[0](anywhere) - at.foundation[0], at.w[1](anywhere) - at.foundation[1]};
        const double w_n = w[0] * n[0] + w[1] * n[1];
        w_t = {w[0] - w_n * n[0], w[1] - w_n * n[1]};
        speed = std::sqrt(w_t[0] * w_t[0] + w_t[1] * w_t[1] + eps * eps);
        for (std::size_t a = 0; a < 2; ++a) {
            for (std::size_t b = 0; b < 2; ++b) {
                tangent[a][b] = (a == b ? 1.0 : 0.0) - n[a] * n[b];
            }
        }
    }

    bool slips(double eps) const { return std::hypot(w_t[0], w_t[1]) > eps; }
};

}  // namespace thermocontact::fem

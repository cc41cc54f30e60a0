/// Polynomials in the barycentric coordinates of a triangle, integrated in closed form: what kernels are
/// compared with.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "mesh/mesh.h"

namespace thermocontact::support {

using Powers = std::array<int, 3>;
using Vector2 = std::array<double, 2>;

/// Sum of coefficient * l0^a l1^b l2^c. Not unique, as l0 + l1 + l2 = 1; values, gradients and integrals are.
class Polynomial {
  public:
    Polynomial(double constant = 0.0) : terms_{{{0, 0, 0}, constant}} {}

    /// The barycentric coordinate of vertex `i`.
    static Polynomial coordinate(std::size_t i) {
        Polynomial result;
        Powers powers{};
        powers[i] = 1;
        result.terms_ = {{powers, 1.0}};
        return result;
    }

    friend Polynomial operator+(Polynomial a, const Polynomial& b) {
        for (const auto& [powers, coefficient] : b.terms_) {
            a.terms_[powers] += coefficient;
        }
        return a;
    }
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial(-1.0) * b; }
    friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
        Polynomial result;
        for (const auto& [p, x] : a.terms_) {
            for (const auto& [q, y] : b.terms_) {
                result.terms_[{p[0] + q[0], p[1] + q[1], p[2] + q[2]}] += x * y;
            }
        }
        return result;
    }

    double operator()(const std::array<double, 3>& l) const {
        double sum = 0;
        for (const auto& [powers, coefficient] : terms_) {
            sum += coefficient * std::pow(l[0], powers[0]) * std::pow(l[1], powers[1]) *
                   std::pow(l[2], powers[2]);
        }
        return sum;
    }

    /// Derivative by l_i, the others held.
    Polynomial derivative(std::size_t i) const {
        Polynomial result;
        for (const auto& [powers, coefficient] : terms_) {
            if (powers[i] > 0) {
                Powers lower = powers;
                --lower[i];
                result.terms_[lower] += coefficient * powers[i];
            }
        }
        return result;
    }

    /// Integral over a triangle of the given area: l0^a l1^b l2^c -> 2 area a! b! c! / (a + b + c + 2)!.
    double over_triangle(double area) const {
        double sum = 0;
        for (const auto& [p, coefficient] : terms_) {
            sum += coefficient * factorial(p[0]) * factorial(p[1]) * factorial(p[2]) /
                   factorial(p[0] + p[1] + p[2] + 2);
        }
        return 2 * area * sum;
    }

    /// Integral over the facet opposite vertex `facet`, of the given length: l_i^a l_j^b -> length a! b! / (a
    /// + b + 1)!.
    double over_facet(std::size_t facet, double length) const {
        double sum = 0;
        for (const auto& [p, coefficient] : terms_) {
            if (p[facet] == 0) {
                const int a = p[(facet + 1) % 3], b = p[(facet + 2) % 3];
                sum += coefficient * factorial(a) * factorial(b) / factorial(a + b + 1);
            }
        }
        return length * sum;
    }

  private:
    static double factorial(int n) { return std::tgamma(n + 1); }

    std::map<Powers, double> terms_;
};

using VectorPolynomial = std::array<Polynomial, 2>;

/// A triangle with everything that closed forms need.
struct Triangle {
    std::array<Vector2, 3> vertices;

    double doubled_area_signed() const {
        const auto& [a, b, c] = vertices;
        return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    }
    double area() const { return std::abs(doubled_area_signed()) / 2; }

    /// grad l_i: normal to the facet opposite vertex i, pointing to the vertex.
    Vector2 gradient(std::size_t i) const {
        const Vector2& p = vertices[(i + 1) % 3];
        const Vector2& q = vertices[(i + 2) % 3];
        return {(p[1] - q[1]) / doubled_area_signed(), (q[0] - p[0]) / doubled_area_signed()};
    }
    VectorPolynomial gradient(const Polynomial& p) const {
        VectorPolynomial result;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector2 direction = gradient(i);
            for (std::size_t c = 0; c < 2; ++c) {
                result[c] = result[c] + p.derivative(i) * direction[c];
            }
        }
        return result;
    }
    double facet_length(std::size_t facet) const {
        const Vector2& p = vertices[(facet + 1) % 3];
        const Vector2& q = vertices[(facet + 2) % 3];
        return std::hypot(p[0] - q[0], p[1] - q[1]);
    }
    Vector2 outward_normal(std::size_t facet) const {
        const Vector2 inward = gradient(facet);
        const double norm = std::hypot(inward[0], inward[1]);
        return {-inward[0] / norm, -inward[1] / norm};
    }

    /// A mesh of this one cell, all of whose facets are on one boundary.
    mesh::Mesh mesh() const {
        std::vector<mesh::Point> points;
        for (const Vector2& x : vertices) {
            points.push_back({x[0], x[1], 0.0});
        }
        return {2, "triangle", points, 3, {0, 1, 2}, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {"all"}};
    }
};

/// Lagrange shape functions in Basix's order: vertices, then (degree 2) the midpoints of the facets opposite
/// 0, 1, 2.
inline std::vector<Polynomial> shape_functions(int degree) {
    std::vector<Polynomial> result;
    for (std::size_t i = 0; i < 3; ++i) {
        const Polynomial l = Polynomial::coordinate(i);
        result.push_back(degree == 1 ? l : l * (2.0 * l - 1.0));
    }
    for (std::size_t i = 0; degree == 2 && i < 3; ++i) {
        result.push_back(4.0 * Polynomial::coordinate((i + 1) % 3) * Polynomial::coordinate((i + 2) % 3));
    }
    return result;
}

/// Barycentric coordinates of the nodes, in the same order.
inline std::vector<std::array<double, 3>> node_coordinates(int degree) {
    std::vector<std::array<double, 3>> result{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (degree == 2) {
        result.insert(result.end(), {{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}});
    }
    return result;
}

}  // namespace thermocontact::support

#include "fem/element.h"

#include <basix/cell.h>
#include <basix/finite-element.h>
#include <basix/version.h>

#include <map>
#include <span>
#include <stdexcept>

#include "fem/shape_values.h"

namespace thermocontact::fem {
namespace {

basix::cell::type cell_type(const std::string& cell) {
    static const std::map<std::string, basix::cell::type> types = {
        {"triangle", basix::cell::type::triangle},
        {"quadrilateral", basix::cell::type::quadrilateral},
        {"tetrahedron", basix::cell::type::tetrahedron},
        {"hexahedron", basix::cell::type::hexahedron}};
    if (const auto found = types.find(cell); found != types.end()) {
        return found->second;
    }
    throw std::logic_error("no element for cell " + cell);
}

bool is_simplex(basix::cell::type cell) {
    return cell == basix::cell::type::triangle || cell == basix::cell::type::tetrahedron;
}

auto create(basix::cell::type cell, int degree) {
#if BASIX_VERSION_MAJOR == 0 && BASIX_VERSION_MINOR < 7
    return basix::create_element(basix::element::family::P, cell, degree,
                                 basix::element::lagrange_variant::gll_warped, false);
#else
    return basix::create_element<double>(basix::element::family::P, cell, degree,
                                         basix::element::lagrange_variant::gll_warped,
                                         basix::element::dpc_variant::unset, false);
#endif
}

/// Linear shape functions of a simplex: 1 - sum X_i, X_1, ..., X_d. In closed form, so that nodes on a side
/// of a body lie on it without round-off.
std::vector<double> affine_weights(std::span<const double> X) {
    std::vector<double> weights(1, 1.0);
    for (const double x : X) {
        weights.push_back(x);
        weights[0] -= x;
    }
    return weights;
}

/// Multilinear shape functions of a square or cube: the first direction changes fastest.
std::vector<double> multilinear_weights(std::span<const double> X) {
    std::vector<double> weights(std::size_t{1} << X.size(), 1.0);
    for (std::size_t vertex = 0; vertex < weights.size(); ++vertex) {
        for (std::size_t i = 0; i < X.size(); ++i) {
            weights[vertex] *= (vertex >> i) % 2 == 1 ? X[i] : 1.0 - X[i];
        }
    }
    return weights;
}

std::vector<std::vector<double>> geometry_weights(basix::cell::type cell, const std::vector<double>& points) {
    const auto dimension = static_cast<std::size_t>(basix::cell::topological_dimension(cell));
    std::vector<std::vector<double>> weights;
    for (std::size_t p = 0; p < points.size(); p += dimension) {
        const std::span<const double> X(&points[p], dimension);
        weights.push_back(is_simplex(cell) ? affine_weights(X) : multilinear_weights(X));
    }
    return weights;
}

}  // namespace

LagrangeElement make_lagrange(const std::string& cell, int degree) {
    const auto type = cell_type(cell);
    const auto element = create(type, degree);
    const auto dimension = static_cast<std::size_t>(basix::cell::topological_dimension(type));
    return {degree,
            element.dim(),
            geometry_weights(type, element.points().first),
            element.entity_dofs(),
            basix::cell::topology(type),
            element.entity_closure_dofs()[dimension - 1]};
}

std::vector<double> shape_values(const std::string& cell, int degree, std::span<const double> points) {
    const auto type = cell_type(cell);
    const auto dimension = static_cast<std::size_t>(basix::cell::topological_dimension(type));
    return create(type, degree).tabulate(0, points, {points.size() / dimension, dimension}).first;
}

}  // namespace thermocontact::fem

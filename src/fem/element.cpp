#include "fem/element.h"

#include <basix/cell.h>
#include <basix/finite-element.h>
#include <basix/version.h>

#include <stdexcept>

namespace thermocontact::fem {
namespace {

basix::cell::type cell_type(const std::string& cell) {
    if (cell == "triangle") {
        return basix::cell::type::triangle;
    }
    throw std::logic_error("no element for cell " + cell);
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

/// Affine coordinates of reference points of a simplex: (1 - sum X_i, X_1, ..., X_d).
std::vector<std::vector<double>> affine_coordinates(const std::vector<double>& points,
                                                    std::size_t dimension) {
    std::vector<std::vector<double>> weights;
    for (std::size_t p = 0; p < points.size(); p += dimension) {
        std::vector<double> row(1, 1.0);
        for (std::size_t i = 0; i < dimension; ++i) {
            row.push_back(points[p + i]);
            row[0] -= points[p + i];
        }
        weights.push_back(row);
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
            affine_coordinates(element.points().first, dimension),
            element.entity_dofs(),
            basix::cell::topology(type),
            element.entity_closure_dofs()[dimension - 1]};
}

}  // namespace thermocontact::fem

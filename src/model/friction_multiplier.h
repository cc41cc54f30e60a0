/// The multiplier of exact Coulomb friction (forms/coulomb.py) on the facets of one surface.
///
/// Only its values at the points of the surface's rule matter. They are kept as the coefficients x of a
/// function of degree 2 on each facet: with Phi its basis at the points and W their weights, a form that is
/// tested with the basis gives Phi^T W lam, and x = (Phi^T W Phi)^+ Phi^T W lam has Phi x = lam where Phi has
/// full row rank. So it has for the rules "vertex" and of degrees 1, 2 and 4 (1, 2, 3 points on an interval
/// and so many squared on a quadrilateral; 1, 3, 6 on a triangle). The scene's rules refuse others.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/form.h"
#include "mesh/mesh.h"

namespace thermocontact::model {

class FrictionMultiplier {
  public:
    /// Zero. `degree` of the space of the unknowns, which the kernels are looked up by; `rule` as in
    /// ContactSurface.
    FrictionMultiplier(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, int rule, int degree,
                       int components);

    /// Coefficient of forms on the facet that show() named last; its address stays.
    fem::Field on_facet() const { return {&shown_, components_, nullptr}; }
    void show(std::size_t facet);

    /// Entries of a form that is tested with the vector-valued basis of degree 2: [nodes of a
    /// cell][components].
    std::size_t functional_size() const { return shown_.size(); }

    /// The multiplier of a facet from the integrals of its products with the basis [functional_size()].
    void take(std::size_t facet, std::span<const double> functional);

    /// Pa, [facets][nodes of degree 2 of a facet][components].
    const std::vector<double>& values() const { return values_; }
    std::vector<double>& values() { return values_; }

    /// gamma, Pa s/m: of the forms that read the multiplier.
    double slip_stiffness = 1;

  private:
    std::span<double> row(std::size_t facet);
    /// Nodes of degree 2 of the facet among those of its cell.
    const std::vector<int>& nodes_of(std::size_t facet) const;

    int components_;
    std::vector<std::int32_t> local_;            ///< [facets]: number of the facet in its cell
    std::vector<std::vector<int>> facet_nodes_;  ///< [facets of a cell]
    std::vector<Eigen::MatrixXd> inverses_;      ///< [facets]: (Phi^T W Phi)^+
    std::vector<double> values_;
    std::vector<double> shown_;  ///< [nodes of a cell][components], zero off the facet
};

}  // namespace thermocontact::model

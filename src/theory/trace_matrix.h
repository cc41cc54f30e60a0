/// A matrix assembled over facets, kept as the tensors of its facets.
#pragma once

#include <vector>

#include "fem/form.h"

namespace thermocontact::theory {

class TraceMatrix {
  public:
    /// Evaluates the bilinear form on `facets`, times the factor of each [facets]; none: 1. The fields have
    /// `components` at each node.
    TraceMatrix(fem::Form form, const std::vector<mesh::Facet>& facets, const fem::Dofmap& dofmap,
                int components, const std::vector<double>& factors = {});

    /// y = A x; y has its size already.
    void multiply(const std::vector<double>& x, std::vector<double>& y) const;

  private:
    std::size_t dofs_per_cell_;
    std::vector<std::size_t> dofs_;  ///< [facets][dofs of the facet's cell]
    std::vector<double> tensors_;    ///< [facets][dofs of the cell][dofs of the cell]
};

}  // namespace thermocontact::theory

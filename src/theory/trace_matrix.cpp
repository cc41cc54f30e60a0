#include "theory/trace_matrix.h"

#include <algorithm>

namespace thermocontact::theory {

TraceMatrix::TraceMatrix(fem::Form form, const std::vector<mesh::Facet>& facets, const fem::Dofmap& dofmap,
                         int components, const std::vector<double>& factors)
    : dofs_per_cell_(static_cast<std::size_t>(dofmap.nodes_per_cell * components)) {
    const std::size_t size = dofs_per_cell_ * dofs_per_cell_;
    const auto block = static_cast<std::size_t>(components);
    tensors_.assign(facets.size() * size, 0.0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (const std::int32_t node : dofmap.of(facets[f].cell)) {
            for (std::size_t c = 0; c < block; ++c) {
                dofs_.push_back(static_cast<std::size_t>(node) * block + c);
            }
        }
        const std::span<double> tensor(tensors_.data() + f * size, size);
        form.add_facet(facets[f], tensor);
        for (double& entry : tensor) {
            entry *= factors.empty() ? 1.0 : factors[f];
        }
    }
}

void TraceMatrix::multiply(const std::vector<double>& x, std::vector<double>& y) const {
    std::ranges::fill(y, 0.0);
    const double* entry = tensors_.data();
    for (std::size_t first = 0; first < dofs_.size(); first += dofs_per_cell_) {
        for (std::size_t i = first; i < first + dofs_per_cell_; ++i) {
            for (std::size_t j = first; j < first + dofs_per_cell_; ++j) {
                y[dofs_[i]] += *entry++ * x[dofs_[j]];
            }
        }
    }
}

}  // namespace thermocontact::theory

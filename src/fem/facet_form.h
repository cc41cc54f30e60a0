/// A form over given facets that is evaluated again and again, of fields that it takes on the facets alone.
///
/// Off a facet's own nodes shape functions vanish on it: only the values there are gathered, and only the
/// entries of its nodes come out. Geometry is gathered once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fem/form.h"
#include "fem/space.h"

namespace thermocontact::fem {

/// The nodes of facets, in the space and in their cells; the same number for each facet.
class FacetNodes {
  public:
    FacetNodes(const Space& space, const std::vector<mesh::Facet>& facets);

    const std::vector<mesh::Facet>& facets() const { return *facets_; }
    std::size_t per_facet() const { return per_facet_; }
    std::span<const std::int32_t> of(std::size_t facet) const {
        return {nodes_.data() + facet * per_facet_, per_facet_};
    }
    /// Their numbers in the facet's cell.
    std::span<const int> in_cell(std::size_t facet) const {
        return (*by_local_)[static_cast<std::size_t>((*facets_)[facet].local)];
    }

  private:
    const std::vector<mesh::Facet>* facets_;
    const std::vector<std::vector<int>>* by_local_;
    std::size_t per_facet_ = 0;
    std::vector<std::int32_t> nodes_;  ///< [facets][per_facet_]
};

class FacetForm {
  public:
    /// A form of rank 1 or 2 with `components` at each node; its fields live on the space, or are those of
    /// the facet at hand. Keeps references to all but the form.
    FacetForm(Form form, const Space& space, const mesh::Mesh& mesh, const FacetNodes& nodes, int components);

    /// The tensor of a facet over its nodes: [nodes][components], of rank 2 that squared. It stays until the
    /// next call. Of rank 1 it is computed only where a value that it takes has changed since the last time.
    std::span<const double> tensor(std::size_t facet);

    void set_constant(const std::string& name, double value);

  private:
    void gather(std::size_t facet);
    void spread(std::size_t facet);
    void compute(std::size_t facet, double* result);

    Form form_;
    const FacetNodes* nodes_;
    std::size_t components_, cell_nodes_;
    std::vector<double> coordinates_;   ///< [facets][vertices of a cell][3]
    std::vector<double> inputs_;        ///< of the facet at hand, at its nodes
    std::vector<double> coefficients_;  ///< the same in the places of the kernel; elsewhere zeros
    std::vector<double> cell_tensor_;
    std::vector<double> results_;      ///< [facets][entries] of rank 1, else [entries] of the facet at hand
    std::vector<double> inputs_then_;  ///< [facets][inputs]: what they were computed from
    std::vector<char> known_;          ///< [facets]: whether they were, with the present constants
    std::size_t entries_ = 0;          ///< of a result
};

}  // namespace thermocontact::fem

/// Gradients of discrete fields, recovered to a higher order by polynomial-preserving recovery (Z. Zhang and
/// A. Naga, A new finite element gradient recovery method: superconvergence property, SIAM J. Sci. Comput. 26
/// (2005) 1192-1213): at each vertex the gradient of the polynomial of degree p + 1 that fits the values at
/// the nodes around best; at the middle of an edge the mean of what its ends' polynomials say there. Of a
/// polynomial of degree p + 1, given by its values at the nodes, it is the gradient itself, on any mesh.
///
/// Nothing crosses from one set of cells to another (`sets`), as gradients jump where materials do.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/space.h"
#include "mesh/mesh.h"

namespace thermocontact::model {

class GradientRecovery {
  public:
    /// `sets` [cells]: the set of each; empty: one. Simplices only. Keeps references to mesh and space.
    GradientRecovery(const mesh::Mesh& mesh, const fem::Space& space, const std::vector<std::int32_t>& sets);

    /// Where recovered values live: the nodes of each set.
    const fem::Dofmap& dofmap() const { return sites_; }

    /// Of each component of `values` [nodes][components]: [components][sites][dimension].
    std::vector<std::vector<double>> operator()(const std::vector<double>& values, int components) const;

  private:
    struct Fit;

    std::vector<std::int32_t> neighbours(const std::vector<std::int32_t>& cells) const;
    std::vector<std::int32_t> nodes_of(const std::vector<std::int32_t>& cells) const;
    Fit fit_around(std::int32_t site) const;
    std::vector<std::int32_t> edges_at(std::int32_t site) const;
    std::int32_t vertex_site(std::int32_t cell, int vertex) const;

    const mesh::Mesh* mesh_;
    const fem::Space* space_;
    fem::Dofmap sites_;
    std::vector<std::int32_t> node_of_;                    ///< [sites]
    std::vector<std::vector<std::int32_t>> cells_around_;  ///< [sites]: those of the set
};

}  // namespace thermocontact::model

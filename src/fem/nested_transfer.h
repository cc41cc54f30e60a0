/// Fields between the spaces of two forests of the same base: the values that one has at the nodes of the
/// other. Exact where the other is as fine or finer, as its functions are among those of the finer space;
/// elsewhere nodal interpolation. Barycentric coordinates are halved and doubled only, hence exact.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/space.h"
#include "mesh/forest.h"

namespace thermocontact::fem {

/// A forest with its mesh and the space on all of it.
struct ForestSpace {
    mesh::Forest forest;
    mesh::Mesh mesh;
    Space space;

    ForestSpace(mesh::Forest of, int degree)
        : forest(std::move(of)), mesh(forest.mesh()), space(make_space(mesh, degree)) {}
};

class NestedTransfer {
  public:
    NestedTransfer(const ForestSpace& from, const ForestSpace& to);

    /// [nodes of `to`][components] from [nodes of `from`][components]. Throws std::logic_error where there
    /// are not so many values.
    std::vector<double> operator()(const std::vector<double>& values, int components) const;

  private:
    std::size_t old_nodes_;
    std::vector<std::int32_t> first_{0};  ///< [nodes of `to` + 1]: where its row begins
    std::vector<std::int32_t> nodes_;     ///< of `from`
    std::vector<double> weights_;
};

}  // namespace thermocontact::fem

/// A finite-element function of one mesh as a function of a finer one, exactly where the meshes are nested.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/space.h"
#include "mesh/mesh.h"
#include "scene/scene.h"

namespace thermocontact::plan {

/// A rectangle or box of a scene with what lives on it.
struct Domain {
    scene::MeshSpec spec;
    mesh::Mesh mesh;
    fem::Space space;
};

/// Values at the nodes of one space from those of another: a sparse row a node.
class Transfer {
  public:
    /// Exact where each cell of `to` lies in one of `from` and the degree is not smaller; else the function
    /// is interpolated.
    Transfer(const Domain& from, const Domain& to);

    /// [nodes][components], of `from` and of `to`.
    std::vector<double> operator()(const std::vector<double>& values, int components) const;

  private:
    std::vector<std::size_t> offsets_;
    std::vector<std::int32_t> columns_;
    std::vector<double> weights_;
};

}  // namespace thermocontact::plan

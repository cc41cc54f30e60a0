/// Which cell of a rectangle or box a point lies in.
#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"

namespace thermocontact::plan {

/// A cell and the point's coordinates in the reference cell.
struct Location {
    std::int32_t cell;
    std::array<double, 3> place;
};

class CellFinder {
  public:
    /// `mesh` is that of `spec`, a shape, and must outlive this.
    CellFinder(const scene::MeshSpec& spec, const mesh::Mesh& mesh);

    /// The cell that the point lies in, or, between several, one of these.
    Location at(const mesh::Point& point) const;

  private:
    std::array<double, 3> reference(std::int32_t cell, const mesh::Point& point) const;

    const mesh::Mesh* mesh_;
    bool simplex_;
    std::array<std::vector<double>, 3> lines_;  ///< coordinates of the lattice along each axis
    std::int32_t cells_of_square_;              ///< or of a cube
};

}  // namespace thermocontact::plan

/// The grid of points, uniform or graded along each axis, that rectangles and boxes are made of.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/grading.h"
#include "mesh/shapes.h"

namespace thermocontact::mesh {

class Lattice {
  public:
    explicit Lattice(const scene::MeshSpec& spec);

    /// Number of point (i, j, k): x changes fastest.
    std::int32_t vertex(std::int32_t i, std::int32_t j, std::int32_t k = 0) const {
        return (k * (cells_[1] + 1) + j) * (cells_[0] + 1) + i;
    }

    /// Number of points.
    std::int32_t size() const;

    /// Cells along an axis (1 along z in 2D).
    std::int32_t cells(std::size_t axis) const { return axis < dimension_ ? cells_[axis] : 1; }

    /// Coordinates (m) of the planes of points across an axis, ascending.
    std::vector<double> planes(std::size_t axis) const;

    /// All points, in their order. Those of the far sides lie exactly where the scene has these.
    std::vector<Point> points() const;

    /// The point at the place (i, j, k), in units of the uniform mesh's cells.
    Point at(double i, double j, double k = 0) const;

    /// The corners of cell (i, j, k) in Basix order: x changes fastest.
    std::vector<std::int32_t> corners(std::int32_t i, std::int32_t j, std::int32_t k = 0) const;

    /// The boundary on which all of the vertices lie, as an index into the sorted names; -1 if there is none.
    std::int32_t side_of(std::span<const std::int32_t> vertices) const;

  private:
    std::size_t dimension_;
    std::array<std::int32_t, 3> cells_{0, 0, 0};
    std::vector<Axis> axes_;  // [dimension_]
};

/// Puts the exterior facets of all cells of a mesh on a lattice in place, sorted by boundary.
void add_sides(const Lattice& lattice, Mesh& mesh);

}  // namespace thermocontact::mesh

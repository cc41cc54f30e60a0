#include "plan/cell_finder.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "mesh/lattice.h"

namespace thermocontact::plan {
namespace {

/// The interval between two lines that holds `x`; beyond the ends the nearest one.
std::int32_t interval_of(const std::vector<double>& lines, double x) {
    const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
    return static_cast<std::int32_t>(above - lines.begin()) - 1;
}

/// How far inside the reference simplex a point is: its smallest barycentric coordinate.
double depth(const std::array<double, 3>& place, int dimension) {
    double first = 1, smallest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i) {
        first -= place[i];
        smallest = std::min(smallest, place[i]);
    }
    return std::min(first, smallest);
}

}  // namespace

CellFinder::CellFinder(const scene::MeshSpec& spec, const mesh::Mesh& mesh)
    : mesh_(&mesh), simplex_(spec.cell == "simplex") {
    const mesh::Lattice lattice(spec);
    std::int32_t squares = 1;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(mesh.dimension); ++axis) {
        for (std::int32_t i = 0; i <= lattice.cells(axis); ++i) {
            std::array<double, 3> at{};
            at[axis] = i;
            lines_[axis].push_back(lattice.at(at[0], at[1], at[2])[axis]);
        }
        squares *= lattice.cells(axis);
    }
    cells_of_square_ = mesh.cell_count() / squares;
}

/// Simplices are affine; squares and cubes of a lattice are affine too.
std::array<double, 3> CellFinder::reference(std::int32_t cell, const mesh::Point& point) const {
    const int d = mesh_->dimension;
    const auto vertices = mesh_->vertices_of(cell);
    const auto vertex = [&](std::size_t v) { return mesh_->points[static_cast<std::size_t>(vertices[v])]; };
    const mesh::Point origin = vertex(0);
    Eigen::MatrixXd jacobian(d, d);
    Eigen::VectorXd offset(d);
    for (int axis = 0; axis < d; ++axis) {
        const std::size_t neighbour = simplex_ ? static_cast<std::size_t>(axis) + 1 : std::size_t{1} << axis;
        const mesh::Point end = vertex(neighbour);
        for (int i = 0; i < d; ++i) {
            const auto at = static_cast<std::size_t>(i);
            jacobian(i, axis) = end[at] - origin[at];
            offset[i] = point[at] - origin[at];
        }
    }
    const Eigen::VectorXd solution = jacobian.partialPivLu().solve(offset);
    std::array<double, 3> place{};
    std::copy(solution.begin(), solution.end(), place.begin());
    return place;
}

Location CellFinder::at(const mesh::Point& point) const {
    std::int32_t square = 0;
    for (auto axis = static_cast<std::size_t>(mesh_->dimension); axis-- > 0;) {
        const auto count = static_cast<std::int32_t>(lines_[axis].size()) - 1;
        square = square * count + interval_of(lines_[axis], point[axis]);
    }
    Location best{};
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::int32_t i = 0; i < cells_of_square_; ++i) {
        const std::int32_t cell = square * cells_of_square_ + i;
        const std::array<double, 3> place = reference(cell, point);
        if (const double inside = depth(place, mesh_->dimension); inside > deepest) {
            deepest = inside;
            best = {cell, place};
        }
    }
    return best;
}

}  // namespace thermocontact::plan

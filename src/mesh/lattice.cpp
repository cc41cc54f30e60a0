#include "mesh/lattice.h"

#include <algorithm>

#include "mesh/cell_shape.h"
#include "mesh/facet_map.h"

namespace thermocontact::mesh {

Lattice::Lattice(const scene::MeshSpec& spec) : dimension_(spec.cells.size()) {
    for (std::size_t axis = 0; axis < dimension_; ++axis) {
        cells_[axis] = spec.cells[axis];
        axes_.push_back({spec.lower[axis], spec.upper[axis], spec.cells[axis],
                         spec.grading.empty() ? scene::Grading{} : spec.grading[axis]});
    }
}

std::int32_t Lattice::size() const {
    return (cells_[0] + 1) * (cells_[1] + 1) * (cells_[2] + 1);
}

Point Lattice::at(double i, double j, double k) const {
    const std::array<double, 3> place{i, j, k};
    Point x{};
    for (std::size_t axis = 0; axis < dimension_; ++axis) {
        x[axis] = coordinate(axes_[axis], place[axis]);
    }
    return x;
}

std::vector<double> Lattice::planes(std::size_t axis) const {
    std::vector<double> result;
    for (std::int32_t i = 0; i <= cells_[axis]; ++i) {
        result.push_back(coordinate(axes_[axis], i));
    }
    return result;
}

std::vector<Point> Lattice::points() const {
    std::vector<Point> points;
    for (std::int32_t k = 0; k <= cells_[2]; ++k) {
        for (std::int32_t j = 0; j <= cells_[1]; ++j) {
            for (std::int32_t i = 0; i <= cells_[0]; ++i) {
                points.push_back(at(i, j, k));
            }
        }
    }
    return points;
}

std::vector<std::int32_t> Lattice::corners(std::int32_t i, std::int32_t j, std::int32_t k) const {
    const std::int32_t count = 1 << dimension_;
    std::vector<std::int32_t> result;
    result.reserve(static_cast<std::size_t>(count));
    for (std::int32_t corner = 0; corner < count; ++corner) {
        result.push_back(vertex(i + corner % 2, j + corner / 2 % 2, k + corner / 4));
    }
    return result;
}

std::int32_t Lattice::side_of(std::span<const std::int32_t> vertices) const {
    // [axis][lower, upper] as they come in the alphabet: back, bottom, front, left, right, top in 3D
    constexpr std::int32_t in_plane[2][2] = {{1, 2}, {0, 3}};
    constexpr std::int32_t in_space[3][2] = {{3, 4}, {1, 5}, {2, 0}};
    if (std::ranges::any_of(vertices, [&](std::int32_t v) { return v >= size(); })) {
        return -1;
    }
    std::int32_t stride = 1;
    for (std::size_t axis = 0; axis < dimension_; stride *= cells_[axis++] + 1) {
        const auto along = [&](std::int32_t v) { return v / stride % (cells_[axis] + 1); };
        for (const int upper : {0, 1}) {
            const std::int32_t wanted = upper * cells_[axis];
            if (std::ranges::all_of(vertices, [&](std::int32_t v) { return along(v) == wanted; })) {
                return dimension_ == 2 ? in_plane[axis][upper] : in_space[axis][upper];
            }
        }
    }
    return -1;
}

void add_sides(const Lattice& lattice, Mesh& mesh) {
    const CellShape& shape = cell_shape(mesh.cell);
    std::vector<char> on_a_side(mesh.points.size());
    for (std::size_t i = 0; i < on_a_side.size(); ++i) {
        const auto vertex = static_cast<std::int32_t>(i);
        on_a_side[i] = lattice.side_of({&vertex, 1}) >= 0 ? 1 : 0;
    }
    const auto inside = [&](std::int32_t vertex) { return on_a_side[static_cast<std::size_t>(vertex)] == 0; };
    std::vector<std::int32_t> vertices;
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (std::ranges::all_of(mesh.vertices_of(cell), inside)) {
            continue;  // as most cells
        }
        for (std::size_t local = 0; local < shape.facets.size(); ++local) {
            const CellFacet facet{cell, static_cast<std::int32_t>(local)};
            gather_vertices(mesh, shape, facet, vertices);
            if (const auto side = lattice.side_of(vertices); side >= 0) {
                mesh.facets.push_back({facet.cell, facet.local, side});
            }
        }
    }
    std::ranges::stable_sort(mesh.facets, {}, &Facet::boundary);
}

}  // namespace thermocontact::mesh

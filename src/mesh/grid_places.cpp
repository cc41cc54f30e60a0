#include "mesh/grid_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/lattice.h"

namespace thermocontact::mesh {
namespace {

/// Nodes inside edges, faces and cells are sums of up to eight weighted vertices: their coordinates are off
/// by some roundings.
constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();

std::int32_t place_of(double x, const std::vector<double>& planes) {
    const double close = roundings * std::max(std::abs(planes.front()), std::abs(planes.back()));
    const auto next = std::ranges::lower_bound(planes, x - close);
    const auto number = static_cast<std::int32_t>(next - planes.begin());
    return next != planes.end() && *next <= x + close ? 2 * number : 2 * number - 1;
}

}  // namespace

std::vector<GridPlace> grid_places(const scene::MeshSpec& spec, std::size_t vertices,
                                   std::span<const Point> nodes) {
    if (spec.file) {
        return {};
    }
    const Lattice lattice(spec);
    const bool has_midpoints = spec.cells.size() == 2 && spec.cell == "simplex" && spec.diagonal == "crossed";
    const std::int32_t midpoints = has_midpoints ? lattice.cells(0) * lattice.cells(1) : 0;
    if (vertices != static_cast<std::size_t>(lattice.size()) + static_cast<std::size_t>(midpoints)) {
        return {};
    }
    std::vector<GridPlace> places(nodes.size(), GridPlace{});
    for (std::size_t axis = 0; axis < spec.cells.size(); ++axis) {
        const std::vector<double> planes = lattice.planes(axis);
        std::ranges::transform(nodes, places, places.begin(), [&](const Point& node, GridPlace place) {
            place[axis] = place_of(node[axis], planes);
            return place;
        });
    }
    return places;
}

}  // namespace thermocontact::mesh

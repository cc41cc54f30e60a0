/// The edges of simplices that bisection goes by (forest.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace thermocontact::mesh {

/// Of a cell of the base: its vertices in the order that Forest::Cell keeps, by their places in the cell, and
/// what the marked edges of a tetrahedron's two faces beside the refinement edge leave out.
struct MarkedEdges {
    std::array<std::int8_t, 4> order{};
    std::array<std::int8_t, 2> left_out{3, 3};
};

MarkedEdges mark_longest(const Mesh& mesh, std::span<const std::int32_t> vertices);

constexpr std::int8_t middle_of_edge = 4;  ///< the place of the new vertex

/// A half of a cell: its vertices by their places in the parent, and its marks.
struct HalfOfCell {
    std::array<std::int8_t, 4> order{};
    std::array<std::int8_t, 2> left_out{3, 3};
    bool flag = false;
};

/// The half that has vertex `kept` (0 or 1) of the refinement edge; marks and flag are the parent's.
HalfOfCell half_of(const std::array<std::int8_t, 2>& left_out, bool flag, std::size_t kept, int vertices);

}  // namespace thermocontact::mesh

/// Nested dissection of nodes on a grid along its planes (A. George, SIAM J. Numer. Anal. 10, 1973).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/grid_places.h"

namespace thermocontact::solve {

/// `nodes` in an order that keeps fill low when they are eliminated, where only nodes couple between which no
/// plane lies (`places`, of all nodes): the plane in the middle of the longest axis parts the nodes into two
/// sets, which come first, each in turn ordered so, and the plane's nodes last.
std::vector<std::int32_t> grid_dissection(std::span<const mesh::GridPlace> places,
                                          std::vector<std::int32_t> nodes);

}  // namespace thermocontact::solve

/// Meshes graded toward sides: where the points along an axis lie.
///
/// A graded mesh is the uniform one, its points moved along each axis by a smooth map of that axis onto
/// itself. With s in [0, 1] the place in the uniform mesh, a >= 1 and b >= 1 the ratios at the lower and the
/// upper side, g = ln(ab), and the place m = ln(a)/g where the two halves meet, the sizes of the cells go as
///
///     dx/ds ~ exp(g (s - m))  for s <= m,    exp(g (m - s))  for s >= m:
///
/// they grow geometrically, by the same factor exp(g/n) from cell to cell of n, from either side to one
/// largest size at m. A ratio is that size over the one at its side: a between s = m and s = 0, b between s =
/// m and s = 1. Where b = 1, m = 1: the growth runs over the whole axis. Integrated, with D = 2 - 1/a - 1/b,
/// a point at s <= m lies
///
///     d(s) = (exp(g s) - 1) / (a D)
///
/// of the axis' length from the lower side; one at s > m lies the same function of 1 - s, with a and b
/// exchanged, from the upper side. A point at m has the mean of both. As each is measured from its own side,
/// equal ratios make a mesh that mirrors itself to the last bit, and as the map does not know n, the points
/// of n cells are every other one of 2n cells, to the last bit. The sizes of finite cells are differences of
/// x: the largest of n cells is a^(1 - 1/n) times the one at the only graded side.
#pragma once

#include "scene/scene.h"

namespace thermocontact::mesh {

/// An axis that is cut into `cells`, from lower to upper (m).
struct Axis {
    double lower, upper;
    int cells;
    scene::Grading grading = {};
};

/// The coordinate (m) of the place in [0, cells], in units of the uniform mesh's cells. The ends lie exactly
/// where the axis has them. The ratios are finite and >= 1.
double coordinate(const Axis& axis, double place);

/// The size (m) of the smallest cell, rounded as the coordinates are.
double smallest_cell(const Axis& axis);

}  // namespace thermocontact::mesh

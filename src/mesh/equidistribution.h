/// How far to refine each cell so that all contribute alike to an error that is aimed at.
#pragma once

#include <vector>

namespace thermocontact::mesh {

/// Bisections of each cell (negative: it may be so much larger), from the squares of its share of the error.
/// A cell that is bisected b times is taken to leave 2^(-2 p b / d) of its square, p the `degree` and d the
/// `dimension`; the fewest cells then that leave `aim`^2 in all share it equally, whence b = d/(2p + d)
/// log2(square/lambda).
std::vector<double> bisections_wanted(const std::vector<double>& squares, double aim, int degree,
                                      int dimension);

}  // namespace thermocontact::mesh

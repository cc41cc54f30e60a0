/// Fronts that are equal: what one eliminates, the other has already.
///
/// Two fronts are equal if the matrix's entries in their columns are, and their children are equal in pairs
/// and lie alike in them: then so are the columns of L that they give. On a grid of equal cells, in the order
/// of a dissection along its planes, most are: of L on 256 x 256 squares in the plane a quarter of the bytes
/// is kept.
///
/// Equal are entries up to round-off, to 2^-44 of the largest one in the columns: cells of one size, made at
/// different places x, differ by their coordinates' round-off, a share 2^-53 x/h of each entry. A matrix
/// whose entries are off by as much is what L belongs to; the elimination's own bound, n 2^-53 for rows of n
/// numbers (N. J. Higham, Accuracy and Stability of Numerical Algorithms, Theorem 10.3), is of that size from
/// n = 500 on.
#pragma once

#include <cstdint>
#include <vector>

#include "solve/front_tree.h"

namespace thermocontact::solve {

/// Of the largest entry in a front's columns: what entries may differ by.
constexpr double equal_entries = 0x1p-44;

/// [supernodes]: the first one whose front is equal, itself where none before is. Those with columns from
/// `head` on stay apart.
std::vector<std::int32_t> equal_fronts(const FrontTree& tree, std::int32_t head);

}  // namespace thermocontact::solve

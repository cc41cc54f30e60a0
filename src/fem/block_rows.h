/// What some of a matrix's nodes contribute to its products: the pieces that traversal.h shares out.
#pragma once

#include "fem/block_matrix.h"

namespace thermocontact::fem {

/// Nodes from `begin` on, before `end`.
struct NodeRange {
    std::int32_t begin, end;
};

/// Where the rows of a range are added up: what goes to these nodes themselves, and what to those after each.
/// Both begin with node 0 and may be the same.
struct Target {
    double* here = nullptr;
    double* later = nullptr;
};

/// Adds to y [nodes x rows] factor * A x of the blocks in the rows of the range, and of those that mirror
/// them: what goes to the rows themselves into `y`, what goes to the nodes after each into `later`. Both
/// begin with node 0 and may be the same.
void add_product(const BlockMatrix& matrix, NodeRange range, double factor, const double* x, double* y,
                 double* later);

/// The part of x^T A x of the same blocks, of a symmetric matrix.
double quadratic_form(const BlockMatrix& matrix, NodeRange range, const double* x);

}  // namespace thermocontact::fem

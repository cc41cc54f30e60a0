/// A coupling and its transpose, read once.
#pragma once

#include <optional>

#include "fem/traversal.h"

namespace thermocontact::fem {

/// y := A x and back_y := factor A^T back_x, A [nodes x rows][nodes x 1] with more rows than one.
struct BothWays {
    const BlockMatrix* matrix;
    const std::vector<double>* x;
    std::vector<double>* y;  ///< sizes of both results already
    double factor;
    const std::vector<double>* back_x;
    std::vector<double>* back_y;
};

/// For Traversal::run(). What `products` refers to must stay until then.
Pass pass_of(const BothWays& products);

/// f where B = f A^T up to rounding; nothing where there is none, or A is zero.
std::optional<double> factor_of_transposed(const BlockMatrix& A, const BlockMatrix& B);

}  // namespace thermocontact::fem

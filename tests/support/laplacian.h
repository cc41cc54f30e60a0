/// A sparse matrix of a grid.
#pragma once

#include <cstdint>

#include "solve/symmetric_matrix.h"

namespace thermocontact::support {

/// Five-point differences on n x n nodes, x changing fastest, with `diagonal` > 4: positive definite.
inline solve::SymmetricMatrix laplacian(std::int32_t n, double diagonal) {
    solve::SymmetricMatrix grid{n * n, {0}, {}, {}};
    for (std::int32_t i = 0; i < n * n; ++i) {
        grid.rows.push_back(i);
        grid.values.push_back(diagonal);
        for (const std::int32_t other : {i + 1, i + n}) {
            if (other < n * n && (other == i + n || other % n != 0)) {
                grid.rows.push_back(other);
                grid.values.push_back(-1.0);
            }
        }
        grid.offsets.push_back(static_cast<std::int32_t>(grid.rows.size()));
    }
    return grid;
}

}  // namespace thermocontact::support

/// Sparse symmetric matrices as the direct solvers take them.
#pragma once

#include <cstdint>
#include <vector>

namespace thermocontact::solve {

/// A symmetric matrix, lower triangle by compressed columns.
struct SymmetricMatrix {
    std::int32_t size;
    std::vector<std::int32_t> offsets;
    std::vector<std::int32_t> rows;
    std::vector<double> values;
};

}  // namespace thermocontact::solve

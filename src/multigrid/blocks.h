/// Dense blocks in single precision, as multigrid's matrices and vectors hold them: columns one after
/// another, each padded with zeros to the lanes of a vector instruction. Nodal vectors are padded alike.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace thermocontact::multigrid {

/// Floats that a column, or a node's entries, of `size` take.
constexpr int lanes(int size) {
    return size <= 2 ? size : size <= 4 ? 4 : 8;
}

/// A block's column, or a node's entries.
template <int size>
using Column = Eigen::Array<float, lanes(size), 1>;
template <int size>
using ColumnMap = Eigen::Map<Column<size>>;
template <int size>
using ConstColumnMap = Eigen::Map<const Column<size>>;

/// Where a column of a block with that many rows begins.
template <int rows, typename Float>
Float* column_of(Float* block, int column) {
    return block + std::ptrdiff_t{column} * lanes(rows);
}

/// B x for a block of `rows` and `columns`.
template <int rows, int columns>
inline Column<rows> product(const float* block, const float* x) {
    Column<rows> sum = ConstColumnMap<rows>(block) * x[0];
    for (int c = 1; c < columns; ++c) {
        sum += ConstColumnMap<rows>(column_of<rows>(block, c)) * x[c];
    }
    return sum;
}

/// y += B^T x
template <int rows, int columns>
inline void add_transposed_product(const float* block, const Column<rows>& x, float* y) {
    for (int c = 0; c < columns; ++c) {
        y[c] += (ConstColumnMap<rows>(column_of<rows>(block, c)) * x).sum();
    }
}

/// Calls function.operator()<size>() for the number of unknowns at a node: 1 to 3 of a fine level, 3 or 6
/// rigid motions of a coarse one.
template <typename Function>
decltype(auto) with_size(int size, Function&& function) {
    switch (size) {
        case 1:
            return std::forward<Function>(function).template operator()<1>();
        case 2:
            return std::forward<Function>(function).template operator()<2>();
        case 3:
            return std::forward<Function>(function).template operator()<3>();
        case 6:
            return std::forward<Function>(function).template operator()<6>();
        default:
            throw std::logic_error("multigrid: unknowns of a node");
    }
}

/// The same for a pair of levels: scalars stay scalars, vectors become rigid motions, these stay what they
/// are.
template <typename Function>
decltype(auto) with_sizes(int fine, int coarse, Function&& function) {
    if (fine == 1 && coarse == 1) {
        return std::forward<Function>(function).template operator()<1, 1>();
    }
    if (fine == 2 && coarse == 3) {
        return std::forward<Function>(function).template operator()<2, 3>();
    }
    if (fine == 3 && coarse == 3) {
        return std::forward<Function>(function).template operator()<3, 3>();
    }
    if (fine == 3 && coarse == 6) {
        return std::forward<Function>(function).template operator()<3, 6>();
    }
    if (fine == 6 && coarse == 6) {
        return std::forward<Function>(function).template operator()<6, 6>();
    }
    throw std::logic_error("multigrid: unknowns of a node on two levels");
}

}  // namespace thermocontact::multigrid

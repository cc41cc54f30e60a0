/// Symmetric matrices in another order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "solve/symmetric_matrix.h"

namespace thermocontact::support {

using solve::SymmetricMatrix;

/// The matrix with row order[i] as its i-th; rows of a column not sorted.
inline SymmetricMatrix permuted(const SymmetricMatrix& matrix, std::span<const std::int32_t> order) {
    std::vector<std::int32_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
    }
    SymmetricMatrix result{matrix.size, std::vector<std::int32_t>(order.size() + 1, 0),
                           std::vector<std::int32_t>(matrix.rows.size()),
                           std::vector<double>(matrix.values.size())};
    const auto each_entry = [&](auto&& call) {
        for (std::size_t column = 0; column < order.size(); ++column) {
            for (auto i = static_cast<std::size_t>(matrix.offsets[column]);
                 i < static_cast<std::size_t>(matrix.offsets[column + 1]); ++i) {
                const auto [first, last] =
                    std::minmax(place[column], place[static_cast<std::size_t>(matrix.rows[i])]);
                call(static_cast<std::size_t>(first), last, matrix.values[i]);
            }
        }
    };
    each_entry([&](std::size_t column, std::int32_t, double) { ++result.offsets[column + 1]; });
    std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
    std::vector<std::int32_t> next(result.offsets.begin(), result.offsets.end() - 1);
    each_entry([&](std::size_t column, std::int32_t row, double value) {
        const auto at = static_cast<std::size_t>(next[column]++);
        result.rows[at] = row;
        result.values[at] = value;
    });
    return result;
}

}  // namespace thermocontact::support

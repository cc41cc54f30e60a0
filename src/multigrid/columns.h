/// A compressed pattern read by its columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace thermocontact::multigrid {

/// Where each column's entries stand: their rows and places.
struct Columns {
    std::vector<std::int32_t> offsets, rows, places;
};

/// Of the rows `offsets` [rows + 1], `columns`, of which there are `count`; each column's rows are in order.
Columns by_column(const std::vector<std::int32_t>& offsets, const std::vector<std::int32_t>& columns,
                  std::size_t count);

}  // namespace thermocontact::multigrid

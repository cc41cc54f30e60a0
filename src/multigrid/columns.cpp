#include "multigrid/columns.h"

#include <numeric>

namespace thermocontact::multigrid {

Columns by_column(const std::vector<std::int32_t>& offsets, const std::vector<std::int32_t>& columns,
                  std::size_t count) {
    Columns result;
    result.offsets.assign(count + 1, 0);
    for (const std::int32_t column : columns) {
        ++result.offsets[static_cast<std::size_t>(column) + 1];
    }
    std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
    result.rows.resize(columns.size());
    result.places.resize(columns.size());
    auto next = result.offsets;
    for (std::size_t row = 0; row + 1 < offsets.size(); ++row) {
        for (auto place = offsets[row]; place < offsets[row + 1]; ++place) {
            const auto column = static_cast<std::size_t>(columns[static_cast<std::size_t>(place)]);
            const auto to = static_cast<std::size_t>(next[column]++);
            result.rows[to] = static_cast<std::int32_t>(row);
            result.places[to] = place;
        }
    }
    return result;
}

}  // namespace thermocontact::multigrid

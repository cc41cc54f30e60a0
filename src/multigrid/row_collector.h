/// Rows of blocks put together entry by entry.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace thermocontact::multigrid {

/// Collects the blocks of one row by their columns.
class RowCollector {
  public:
    /// `length`: floats of a block.
    RowCollector(std::size_t columns, std::size_t length) : place_(columns, -1), length_(length) {}

    float* at(std::int32_t column) {
        std::int32_t& place = place_[static_cast<std::size_t>(column)];
        if (place < 0) {
            place = static_cast<std::int32_t>(columns_.size());
            columns_.push_back(column);
            values_.resize(values_.size() + length_, 0.0F);
        }
        return values_.data() + static_cast<std::size_t>(place) * length_;
    }

    /// Appends the row in order of its columns, or of key(column), and begins another.
    template <typename Key = std::identity>
    void finish(std::vector<std::int32_t>& offsets, std::vector<std::int32_t>& columns,
                std::vector<float>& values, Key key = {}) {
        std::vector<std::int32_t> order = columns_;
        std::ranges::sort(order, {}, key);
        for (const std::int32_t column : order) {
            std::int32_t& place = place_[static_cast<std::size_t>(column)];
            const float* block = values_.data() + static_cast<std::size_t>(place) * length_;
            values.insert(values.end(), block, block + length_);
            columns.push_back(column);
            place = -1;
        }
        offsets.push_back(static_cast<std::int32_t>(columns.size()));
        columns_.clear();
        values_.clear();
    }

  private:
    std::vector<std::int32_t> place_;  ///< [columns]
    std::vector<std::int32_t> columns_;
    std::vector<float> values_;
    std::size_t length_;
};

}  // namespace thermocontact::multigrid

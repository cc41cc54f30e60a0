#include "solve/front_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace thermocontact::solve {

FrontTree::FrontTree(const SymmetricMatrix& matrix, const Supernodes& supernodes)
    : matrix_(&matrix),
      supernodes_(&supernodes),
      place_(static_cast<std::size_t>(matrix.size)),
      offsets_(supernodes.count() + 1, 0) {
    for (std::size_t i = 0; i < place_.size(); ++i) {
        place_[static_cast<std::size_t>(supernodes.order()[i])] = static_cast<std::int32_t>(i);
    }
    find_children();
    order_rows();
}

void FrontTree::find_children() {
    const Supernodes& supernodes = *supernodes_;
    std::vector<std::size_t> owner(place_.size());
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        std::fill_n(owner.begin() + supernodes[s].first, supernodes[s].columns, s);
    }
    const auto each_child = [&](auto&& call) {
        for (std::size_t s = 0; s < supernodes.count(); ++s) {
            if (const auto below = supernodes[s].below(); !below.empty()) {
                call(s, owner[static_cast<std::size_t>(below.front())]);
            }
        }
    };
    each_child([&](std::size_t, std::size_t parent) { ++offsets_[parent + 1]; });
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    children_.resize(offsets_.back());
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    each_child([&](std::size_t child, std::size_t parent) {
        children_[next[parent]++] = static_cast<std::int32_t>(child);
    });
}

void FrontTree::order_rows() {
    const Supernodes& supernodes = *supernodes_;
    std::vector<std::size_t> taken(place_.size(), supernodes.count());  // by which supernode, the last one
    begins_.push_back(0);
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        const Supernode supernode = supernodes[s];
        std::fill_n(taken.begin() + supernode.first, supernode.columns, s);
        const auto take = [&](std::int32_t row) {
            if (std::exchange(taken[static_cast<std::size_t>(row)], s) != s) {
                below_.push_back(row);
            }
        };
        for (const std::int32_t child : children(s)) {
            const auto [begin, end] = std::pair(begins_[static_cast<std::size_t>(child)],
                                                begins_[static_cast<std::size_t>(child) + 1]);
            for (std::size_t i = begin; i < end; ++i) {
                take(below_[i]);
            }
        }
        each_of_matrix(s,
                       [&](std::int32_t, std::size_t row, double) { take(static_cast<std::int32_t>(row)); });
        std::ranges::for_each(supernode.below(), take);  // of columns that were joined, if any are left
        begins_.push_back(below_.size());
    }
}

std::span<const std::int32_t> FrontTree::below(std::size_t number) const {
    return std::span(below_).subspan(begins_[number], begins_[number + 1] - begins_[number]);
}

std::span<const std::int32_t> FrontTree::children(std::size_t number) const {
    return std::span(children_).subspan(offsets_[number], offsets_[number + 1] - offsets_[number]);
}

void FrontTree::locate(std::size_t number, std::vector<std::int32_t>& local) const {
    local.resize(place_.size());
    const Supernode supernode = (*supernodes_)[number];
    std::iota(local.begin() + supernode.first, local.begin() + supernode.first + supernode.columns, 0);
    std::int32_t place = supernode.columns;
    for (const std::int32_t row : below(number)) {
        local[static_cast<std::size_t>(row)] = place++;
    }
}

void FrontTree::places(std::size_t child, const std::vector<std::int32_t>& local,
                       std::vector<std::int32_t>& result) const {
    const auto rows = below(child);
    result.resize(rows.size());
    std::ranges::transform(rows, result.begin(),
                           [&](std::int32_t row) { return local[static_cast<std::size_t>(row)]; });
}

}  // namespace thermocontact::solve

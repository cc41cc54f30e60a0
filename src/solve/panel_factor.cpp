#include "solve/panel_factor.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "solve/branches.h"

namespace thermocontact::solve {
namespace {

constexpr int branch_count = 4;  ///< as many cores exhaust the memory of most machines

/// Bytes of a panel stored by groups.
std::int64_t panel_bytes(Storage storage, std::int32_t columns, std::int32_t rows) {
    std::int64_t bytes = 0;
    for (std::int32_t c = 0; c < columns; c += group) {
        bytes += group_bytes(storage, std::min(group, columns - c), rows - c);
    }
    return bytes;
}

/// Numbers in it, the same however they are stored.
std::int64_t stored(std::int32_t columns, std::int32_t rows) {
    return panel_bytes(Storage::doubles, columns, rows) / static_cast<std::int64_t>(sizeof(double));
}

/// Of each supernode, up to the first one without columns in the head: how many it has there.
std::vector<std::int32_t> columns_in_head(const Supernodes& supernodes, std::int32_t head) {
    std::vector<std::int32_t> result;
    for (std::size_t s = 0; s < supernodes.count() && supernodes[s].first < head; ++s) {
        result.push_back(std::min(supernodes[s].columns, head - supernodes[s].first));
    }
    return result;
}

/// The elimination tree of the head by supernodes: above one stands that of the first row below it.
Branches cut(const Supernodes& supernodes, std::span<const std::int32_t> in_head, std::int32_t head,
             std::int64_t smallest_cut) {
    std::vector<std::int32_t> owner(static_cast<std::size_t>(head)), parents;
    std::vector<std::int64_t> weights;
    for (std::size_t s = 0; s < in_head.size(); ++s) {
        const Supernode supernode = supernodes[s];
        std::fill_n(owner.begin() + supernode.first, in_head[s], static_cast<std::int32_t>(s));
        weights.push_back(stored(in_head[s], static_cast<std::int32_t>(supernode.rows.size())));
    }
    for (std::size_t s = 0; s < in_head.size(); ++s) {
        const auto below = supernodes[s].rows.subspan(static_cast<std::size_t>(in_head[s]));
        const bool is_root = below.empty() || below.front() >= head;
        parents.push_back(is_root ? -1 : owner[static_cast<std::size_t>(below.front())]);
    }
    const auto total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
    return cut_into_branches(parents, weights, total < smallest_cut ? 1 : branch_count);
}

std::size_t bytes_of(const Supernodes& supernodes, std::span<const std::int32_t> in_head, Storage storage) {
    std::int64_t bytes = 0;
    for (std::size_t s = 0; s < in_head.size(); ++s) {
        bytes += panel_bytes(storage, in_head[s], static_cast<std::int32_t>(supernodes[s].rows.size()));
    }
    return static_cast<std::size_t>(bytes);
}

}  // namespace

PanelFactor::PanelFactor(const SymmetricMatrix& matrix, std::span<const std::int32_t> order,
                         std::int32_t tail, std::shared_ptr<Workers> workers, Storage storage,
                         std::int64_t smallest_cut)
    : size_(matrix.size),
      head_(matrix.size - tail),
      storage_(storage),
      workers_(std::move(workers)),
      tail_(Eigen::MatrixXd::Zero(tail, tail)) {
    const Supernodes supernodes(matrix, order, tail);
    const std::vector<std::int32_t> in_head = columns_in_head(supernodes, head_);
    const Branches cuts = cut(supernodes, in_head, head_, smallest_cut);
    std::vector<std::int32_t> place(static_cast<std::size_t>(size_));  // in the factor, of CHOLMOD's columns
    std::iota(place.begin(), place.end(), 0);
    std::int32_t next = 0;
    const auto number = [&](std::span<const std::int32_t> chosen) {
        for (const std::int32_t s : chosen) {
            const auto at = static_cast<std::size_t>(s);
            std::iota(place.begin() + supernodes[at].first,
                      place.begin() + supernodes[at].first + in_head[at], next);
            next += in_head[at];
        }
    };
    std::ranges::for_each(cuts.branches, number);
    first_outside_ = next;
    number(cuts.trunk);
    order_.resize(static_cast<std::size_t>(size_));
    for (std::size_t i = 0; i < order_.size(); ++i) {
        order_[static_cast<std::size_t>(place[i])] = supernodes.order()[i];
    }
    bytes_.reserve(bytes_of(supernodes, in_head, storage_));
    for (const std::vector<std::int32_t>& branch : cuts.branches) {
        branches_.push_back(store(supernodes, branch, in_head, place, first_outside_));
    }
    trunk_ = store(supernodes, cuts.trunk, in_head, place, size_);
    store_tail(supernodes);
}

PanelFactor::Branch PanelFactor::store(const Supernodes& supernodes, std::span<const std::int32_t> chosen,
                                       std::span<const std::int32_t> in_head,
                                       std::span<const std::int32_t> place, std::int32_t end) {
    Branch branch{panels_.size(), panels_.size(), {}, {}};
    std::size_t most_rows = 0;
    for (const std::int32_t s : chosen) {
        const auto at = static_cast<std::size_t>(s);
        const Supernode supernode = supernodes[at];
        const std::int32_t columns = in_head[at], rows = static_cast<std::int32_t>(supernode.rows.size());
        Panel panel{place[static_cast<std::size_t>(supernode.first)],
                    columns,
                    rows,
                    static_cast<std::int64_t>(bytes_.size()),
                    static_cast<std::int64_t>(rows_.size()),
                    0};
        entries_ += stored(columns, rows);
        bytes_.resize(bytes_.size() + static_cast<std::size_t>(panel_bytes(storage_, columns, rows)));
        std::byte* L = bytes_.data() + panel.bytes;
        for (std::int32_t c = 0; c < columns; c += group) {
            const std::int32_t width = std::min(group, columns - c);
            store_group(storage_, supernode.column(c) + c, rows, width, rows - c, L);
            L += group_bytes(storage_, width, rows - c);
        }
        for (const std::int32_t row : supernode.rows.subspan(static_cast<std::size_t>(columns))) {
            rows_.push_back(place[static_cast<std::size_t>(row)]);
            panel.within += rows_.back() < end ? 1 : 0;
        }
        panels_.push_back(panel);
        most_rows = std::max(most_rows, supernode.rows.size());
    }
    branch.end = panels_.size();
    branch.buffer.resize(most_rows + chunk);
    branch.outside.resize(static_cast<std::size_t>(size_ - end));
    return branch;
}

void PanelFactor::store_tail(const Supernodes& supernodes) {
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        const Supernode supernode = supernodes[s];
        for (std::int32_t c = std::clamp(head_ - supernode.first, 0, supernode.columns);
             c < supernode.columns; ++c) {
            for (auto r = static_cast<std::size_t>(c); r < supernode.rows.size(); ++r) {
                tail_(supernode.rows[r] - head_, supernode.first + c - head_) = supernode.column(c)[r];
            }
        }
    }
}

void PanelFactor::forward(const Panel& panel, Branch& branch, std::vector<double>& x) const {
    double* local = branch.buffer.data();
    const std::int32_t below = panel.rows - panel.columns;
    std::copy_n(x.data() + panel.first_column, panel.columns, local);
    std::fill_n(local + panel.columns, below, 0.0);
    const std::byte* L = bytes_.data() + panel.bytes;
    for (std::int32_t c = 0; c < panel.columns; c += group) {
        const std::int32_t width = std::min(group, panel.columns - c);
        solve_group(storage_, L, width, panel.rows - c, local + c);
        L += group_bytes(storage_, width, panel.rows - c);
    }
    std::copy_n(local, panel.columns, x.data() + panel.first_column);
    const std::int32_t* rows = rows_.data() + panel.below;
    const double* sums = local + panel.columns;
    for (std::int32_t r = 0; r < panel.within; ++r) {
        x[static_cast<std::size_t>(rows[r])] += sums[r];
    }
    for (std::int32_t r = panel.within; r < below; ++r) {
        branch.outside[static_cast<std::size_t>(rows[r] - first_outside_)] += sums[r];
    }
}

void PanelFactor::forward(std::vector<double>& x) {
    const auto pass = [&](Branch& branch) {
        std::ranges::fill(branch.outside, 0.0);
        for (std::size_t i = branch.begin; i < branch.end; ++i) {
            forward(panels_[i], branch, x);
        }
    };
    workers_->run(static_cast<int>(branches_.size()),
                  [&](int number) { pass(branches_[static_cast<std::size_t>(number)]); });
    for (const Branch& branch : branches_) {
        for (std::size_t i = 0; i < branch.outside.size(); ++i) {
            x[static_cast<std::size_t>(first_outside_) + i] += branch.outside[i];
        }
    }
    pass(trunk_);
}

void PanelFactor::backward(const Panel& panel, Branch& branch, std::vector<double>& x) const {
    double* local = branch.buffer.data();
    const std::int32_t below = panel.rows - panel.columns;
    const std::int32_t* rows = rows_.data() + panel.below;
    std::copy_n(x.data() + panel.first_column, panel.columns, local);
    for (std::int32_t r = 0; r < below; ++r) {
        local[panel.columns + r] = x[static_cast<std::size_t>(rows[r])];
    }
    std::fill_n(local + panel.rows, chunk, 0.0);
    const std::byte* L = bytes_.data() + panel.bytes + panel_bytes(storage_, panel.columns, panel.rows);
    for (std::int32_t c = (panel.columns - 1) / group * group; c >= 0; c -= group) {
        const std::int32_t width = std::min(group, panel.columns - c);
        L -= group_bytes(storage_, width, panel.rows - c);
        solve_group_transposed(storage_, L, width, panel.rows - c, local + c);
    }
    std::copy_n(local, panel.columns, x.data() + panel.first_column);
}

void PanelFactor::backward(std::vector<double>& x) {
    const auto pass = [&](Branch& branch) {
        for (std::size_t i = branch.end; i-- > branch.begin;) {
            backward(panels_[i], branch, x);
        }
    };
    pass(trunk_);
    workers_->run(static_cast<int>(branches_.size()),
                  [&](int number) { pass(branches_[static_cast<std::size_t>(number)]); });
}

Eigen::MatrixXd PanelFactor::schur_complement() const {
    if (tail_.size() == 0) {
        return tail_;  // BLAS refuses empty products
    }
    return tail_.triangularView<Eigen::Lower>() * tail_.transpose();
}

std::vector<std::int32_t> nested_dissection(const SymmetricMatrix& graph) {
    std::vector<std::int32_t> order(static_cast<std::size_t>(graph.size));
    std::iota(order.begin(), order.end(), 0);
    CholmodCommon common;
    cholmod_sparse pattern = view(graph);
    if (graph.size > 0 && cholmod_metis(&pattern, nullptr, 0, 0, order.data(), common.get()) == 0) {
        cholmod_amd(&pattern, nullptr, 0, order.data(), common.get());
        throw_if_failed(common);
    }
    return order;
}

}  // namespace thermocontact::solve

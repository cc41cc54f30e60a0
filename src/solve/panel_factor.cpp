#include "solve/panel_factor.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "fem/throwing_tasks.h"
#include "solve/equal_fronts.h"
#include "solve/front_stages.h"

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

/// The elimination tree by supernodes, of those with columns in the head: above one stands that of the first
/// row below it.
Branches cut(const Supernodes& supernodes, std::span<const std::int32_t> in_head, std::int64_t smallest_cut) {
    std::vector<std::int32_t> owner, parents;
    std::vector<std::int64_t> weights;
    for (std::size_t s = 0; s < in_head.size(); ++s) {
        const Supernode supernode = supernodes[s];
        owner.insert(owner.end(), static_cast<std::size_t>(supernode.columns), static_cast<std::int32_t>(s));
        weights.push_back(stored(in_head[s], static_cast<std::int32_t>(supernode.rows.size())));
    }
    for (std::size_t s = 0; s < in_head.size(); ++s) {
        const auto below = supernodes[s].below();
        const bool is_root = below.empty() || static_cast<std::size_t>(below.front()) >= owner.size();
        parents.push_back(is_root ? -1 : owner[static_cast<std::size_t>(below.front())]);
    }
    const auto total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
    return cut_into_branches(parents, weights, total < smallest_cut ? 1 : branch_count);
}

void in_turn(int count, const std::function<void(int)>& task) {
    for (int i = 0; i < count; ++i) {
        task(i);
    }
}

}  // namespace

/// What is needed while the factor is made.
struct PanelFactor::Making {
    const Supernodes& supernodes;
    std::vector<std::int32_t> in_head;
    std::vector<std::int32_t> place;  ///< in the factor, of the supernodes' columns
    FrontTree tree;
    std::vector<std::int32_t> first;   ///< [supernodes]: of those with equal fronts
    std::vector<std::int64_t> stored;  ///< [supernodes]: of the first ones, start in bytes_; -1: not yet
    Fronts fronts;

    Making(const SymmetricMatrix& matrix, const Supernodes& all, std::int32_t head)
        : supernodes(all),
          in_head(columns_in_head(all, head)),
          place(static_cast<std::size_t>(matrix.size)),
          tree(matrix, all),
          first(equal_fronts(tree, head)),
          stored(all.count(), -1),
          fronts(tree, first) {}
};

PanelFactor::PanelFactor(const SymmetricMatrix& matrix, std::int32_t tail, std::shared_ptr<Workers> workers,
                         Storage storage, std::int64_t smallest_cut)
    : size_(matrix.size),
      head_(matrix.size - tail),
      storage_(storage),
      workers_(std::move(workers)),
      tail_(Eigen::MatrixXd::Zero(tail, tail)) {
    const Supernodes supernodes(matrix, tail);
    Making making(matrix, supernodes, head_);
    const Branches cuts = cut(supernodes, making.in_head, smallest_cut);
    std::iota(making.place.begin(), making.place.end(), 0);
    std::int32_t next = 0;
    const auto number = [&](std::span<const std::int32_t> chosen) {
        for (const std::int32_t s : chosen) {
            const auto at = static_cast<std::size_t>(s);
            const auto begin = making.place.begin() + supernodes[at].first;
            std::iota(begin, begin + making.in_head[at], next);
            next += making.in_head[at];
        }
    };
    std::ranges::for_each(cuts.branches, number);
    const std::int32_t first_outside = next;
    number(cuts.trunk);
    order_.resize(static_cast<std::size_t>(size_));
    for (std::size_t i = 0; i < order_.size(); ++i) {
        order_[static_cast<std::size_t>(making.place[i])] = supernodes.order()[i];
    }
    for (const std::vector<std::int32_t>& branch : cuts.branches) {
        branches_.push_back(lay_out(making, branch, first_outside));
    }
    trunk_ = lay_out(making, cuts.trunk, size_);
    make_numbers(making, cuts);
}

PanelFactor::Branch PanelFactor::lay_out(Making& making, std::span<const std::int32_t> chosen,
                                         std::int32_t end) {
    Branch branch{panels_.size(), panels_.size(), end, {}, {}};
    std::size_t most_rows = 0;
    for (const std::int32_t s : chosen) {
        const auto at = static_cast<std::size_t>(s);
        const Supernode supernode = making.supernodes[at];
        const std::int32_t columns = making.in_head[at],
                           rows = static_cast<std::int32_t>(supernode.rows.size());
        std::int64_t& bytes = making.stored[static_cast<std::size_t>(making.first[at])];
        if (bytes < 0) {
            bytes = all_bytes_;
            all_bytes_ += panel_bytes(storage_, columns, rows);
        }
        panels_.push_back({making.place[static_cast<std::size_t>(supernode.first)], columns, rows, bytes,
                           static_cast<std::int64_t>(rows_.size())});
        entries_ += stored(columns, rows);
        const auto add_row = [&](std::int32_t row) {
            rows_.push_back(making.place[static_cast<std::size_t>(row)]);
        };
        for (std::int32_t c = columns; c < supernode.columns; ++c) {  // in the tail
            add_row(supernode.first + c);
        }
        std::ranges::for_each(making.tree.below(at), add_row);
        most_rows = std::max(most_rows, supernode.rows.size());
    }
    branch.end = panels_.size();
    branch.buffer.resize(most_rows + chunk);
    branch.outside.resize(static_cast<std::size_t>(size_ - end));
    return branch;
}

/// What several branches have, then the branches beside each other, then the trunk and the tail; large fronts
/// are shared where they are not made beside others.
void PanelFactor::make_numbers(Making& making, const Branches& cuts) {
    bytes_.resize(static_cast<std::size_t>(all_bytes_));
    const fem::Beside shared = [this](int count, const std::function<void(int)>& task) {
        workers_->run(count, task);
    };
    const FrontStages stages = front_stages(making.tree, making.first, cuts);
    make(making, stages.common, shared);
    fem::run_throwing(shared, static_cast<int>(branches_.size()), [&](int number) {
        make(making, stages.branches[static_cast<std::size_t>(number)], in_turn);
    });
    make(making, stages.trunk, shared);
    Fronts::Workspace work;
    for (std::size_t s = making.in_head.size(); s < making.supernodes.count(); ++s) {
        store_tail(making, s, making.fronts.factor(s, work, shared));
    }
}

void PanelFactor::make(Making& making, std::span<const std::int32_t> chosen, const fem::Beside& beside) {
    Fronts::Workspace work;
    for (const std::int32_t s : chosen) {
        const auto at = static_cast<std::size_t>(s);
        const double* numbers = making.fronts.factor(at, work, beside);
        const auto rows = static_cast<std::int32_t>(making.supernodes[at].rows.size());
        std::byte* L = bytes_.data() + making.stored[at];
        for (std::int32_t c = 0; c < making.in_head[at]; c += group) {
            const std::int32_t width = std::min(group, making.in_head[at] - c);
            store_group(storage_, numbers + static_cast<std::ptrdiff_t>(c) * rows + c, rows, width, rows - c,
                        L);
            L += group_bytes(storage_, width, rows - c);
        }
        store_tail(making, at, numbers);
    }
}

/// The columns of a supernode that are in the tail.
void PanelFactor::store_tail(const Making& making, std::size_t number, const double* numbers) {
    const Supernode supernode = making.supernodes[number];
    const auto below = making.tree.below(number);
    for (std::int32_t c = std::clamp(head_ - supernode.first, 0, supernode.columns); c < supernode.columns;
         ++c) {
        const std::int32_t column = supernode.first + c - head_;
        const double* of_column = numbers + static_cast<std::size_t>(c) * supernode.rows.size();
        for (std::int32_t r = c; r < supernode.columns; ++r) {
            tail_(supernode.first + r - head_, column) = of_column[r];
        }
        for (std::size_t r = 0; r < below.size(); ++r) {
            tail_(below[r] - head_, column) = of_column[static_cast<std::size_t>(supernode.columns) + r];
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
    for (std::int32_t r = 0; r < below; ++r) {
        double* to = rows[r] < branch.rows ? x.data() : branch.outside.data() - branch.rows;
        to[rows[r]] += sums[r];
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
            x[static_cast<std::size_t>(branch.rows) + i] += branch.outside[i];
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
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(tail_.rows(), tail_.cols());
    result.selfadjointView<Eigen::Lower>().rankUpdate(tail_);
    return result.selfadjointView<Eigen::Lower>();
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

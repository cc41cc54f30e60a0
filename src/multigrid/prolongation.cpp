#include "multigrid/prolongation.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <span>

#include "multigrid/blocks.h"
#include "multigrid/columns.h"
#include "multigrid/row_collector.h"
#include "prefetch.h"

namespace thermocontact::multigrid {
namespace {

constexpr double damping = 4.0 / 3.0;

/// The coarse nodes that rows of this process name: its own, then those of others in order.
class CoarseNodes {
  public:
    CoarseNodes(std::int32_t begin, std::int32_t end, const Rows& rows) : begin_(begin), own_(end - begin) {
        std::set<std::int32_t> others;
        for (const std::int32_t global : rows.columns) {
            if (global < begin || global >= end) {
                others.insert(global);
            }
        }
        global_.resize(static_cast<std::size_t>(own_));
        std::iota(global_.begin(), global_.end(), begin);
        global_.insert(global_.end(), others.begin(), others.end());
    }

    std::int32_t local(std::int32_t global) const {
        if (global >= begin_ && global < begin_ + own_) {
            return global - begin_;
        }
        const auto others = global_.begin() + own_;
        return static_cast<std::int32_t>(std::lower_bound(others, global_.end(), global) - global_.begin());
    }
    const std::vector<std::int32_t>& global() const { return global_; }
    std::size_t count() const { return global_.size(); }

  private:
    std::int32_t begin_, own_;
    std::vector<std::int32_t> global_;
};

/// ((1 - omega A) Q)^T of this part; Q itself counts where the node is owned.
template <int size, int motions>
Rows smoothed(const Matrix& A, const Rows& Q, float omega, const SharedNodes& nodes,
              const CoarseNodes& coarse) {
    constexpr int fine = lanes(size);
    const Columns before = by_column(A.offsets, A.columns, A.offsets.size() - 1);  // the lower triangle
    RowCollector row(coarse.count(), Q.length);
    Rows result{Q.length, {0}, {}, {}};
    const auto global = [&](std::int32_t local) { return coarse.global()[static_cast<std::size_t>(local)]; };
    // block: A_ij by its columns, or A_ji by its rows
    const auto subtract = [&](const float* block, std::int32_t j, bool transposed) {
        const auto entry = static_cast<std::size_t>(Q.offsets[static_cast<std::size_t>(j)]);
        if (entry == static_cast<std::size_t>(Q.offsets[static_cast<std::size_t>(j) + 1])) {
            return;
        }
        const float* from = Q.values.data() + entry * Q.length;
        float* to = row.at(coarse.local(Q.columns[entry]));
        for (int r = 0; r < size; ++r) {
            ColumnMap<motions> sum(column_of<motions>(to, r));
            for (int s = 0; s < size; ++s) {
                sum -= ConstColumnMap<motions>(column_of<motions>(from, s)) *
                       (omega * (transposed ? block[r * fine + s] : block[s * fine + r]));
            }
        }
    };
    const auto add_own = [&](std::size_t i) {
        const auto last = static_cast<std::size_t>(Q.offsets[i + 1]);
        for (auto entry = static_cast<std::size_t>(Q.offsets[i]); entry < last; ++entry) {
            const float* from = Q.values.data() + entry * Q.length;
            float* to = row.at(coarse.local(Q.columns[entry]));
            std::transform(from, from + Q.length, to, to, std::plus<>());
        }
    };
    for (std::size_t i = 0; i + 1 < A.offsets.size(); ++i) {
        const auto end = static_cast<std::size_t>(A.offsets[i + 1]);
        for (auto pair = static_cast<std::size_t>(A.offsets[i]); pair < end; ++pair) {
            subtract(A.block(pair), A.columns[pair], false);
        }
        const auto last = static_cast<std::size_t>(before.offsets[i + 1]);
        for (auto k = static_cast<std::size_t>(before.offsets[i]); k < last; ++k) {
            if (before.rows[k] != static_cast<std::int32_t>(i)) {
                subtract(A.block(static_cast<std::size_t>(before.places[k])), before.rows[k], true);
            }
        }
        if (nodes.owned(i)) {
            add_own(i);
        }
        // sums over the row then have the same order on every process
        row.finish(result.offsets, result.columns, result.values, global);
    }
    std::ranges::transform(result.columns, result.columns.begin(), global);
    return result;
}

/// First coarse node of each process, and the count of all.
std::vector<std::int32_t> first_nodes(std::int32_t count, const parallel::Team& team) {
    std::vector<double> counts(static_cast<std::size_t>(team.size()), 0.0);
    counts[static_cast<std::size_t>(team.rank())] = count;
    team.sum(counts);
    std::vector<std::int32_t> first{0};
    for (const double of_one : counts) {
        first.push_back(first.back() + static_cast<std::int32_t>(of_one));
    }
    return first;
}

template <int size, int motions>
void add_prolonged(const Prolongation& P, const float* coarse, float* fine) {
    constexpr std::ptrdiff_t length = std::ptrdiff_t{size} * lanes(motions);
    const float* block = P.values.data();
    const std::int32_t* column = P.columns.data();
    for (std::size_t i = 0; i + 1 < P.offsets.size(); ++i, fine += lanes(size)) {
        const std::int32_t* end = P.columns.data() + P.offsets[i + 1];
        for (; column < end; ++column, block += length) {
            prefetch_after<static_cast<std::size_t>(length)>(block);
            const Column<motions> from = ConstColumnMap<motions>(column_of<motions>(coarse, *column));
            add_transposed_product<motions, size>(block, from, fine);
        }
    }
}

template <int size, int motions>
void add_restricted(const Prolongation& P, const float* fine, const SharedNodes& nodes,
                    std::vector<float>& coarse) {
    constexpr std::size_t length = std::size_t{size} * lanes(motions);
    for (std::size_t i = 0; i + 1 < P.offsets.size(); ++i, fine += lanes(size)) {
        if (!nodes.owned(i)) {
            continue;
        }
        const auto end = static_cast<std::size_t>(P.offsets[i + 1]);
        for (auto entry = static_cast<std::size_t>(P.offsets[i]); entry < end; ++entry) {
            const float* block = P.values.data() + entry * length;
            prefetch_after<length>(block);
            ColumnMap<motions>(column_of<motions>(coarse.data(), P.columns[entry])) +=
                product<motions, size>(block, fine);
        }
    }
}

template <int motions>
void scale_blocks(Prolongation& P, const Scaling& coarse) {
    using Square = Eigen::Matrix<double, motions, motions, motions == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    using Vector = Eigen::Matrix<float, motions, 1>;
    const auto size = static_cast<std::size_t>(P.fine_size);
    for (std::size_t entry = 0; entry < P.columns.size(); ++entry) {
        const auto node = static_cast<std::size_t>(P.columns[entry]);
        const auto inverse = Eigen::Map<const Square>(coarse.inverse(node)).template cast<float>().eval();
        for (std::size_t r = 0; r < size; ++r) {
            Eigen::Map<Vector> column(P.values.data() + (entry * size + r) * lanes(motions));
            column = (inverse * column).eval();
        }
    }
}

}  // namespace

void Prolongation::scale(const Scaling& coarse) {
    with_size(coarse_size, [&]<int motions>() { scale_blocks<motions>(*this, coarse); });
}

void Prolongation::add_to(const std::vector<float>& coarse, std::vector<float>& fine) const {
    with_sizes(fine_size, coarse_size, [&]<int size, int motions>() {
        add_prolonged<size, motions>(*this, coarse.data(), fine.data());
    });
}

void Prolongation::restrict_to(const std::vector<float>& fine, const SharedNodes& nodes,
                               std::vector<float>& coarse) const {
    std::ranges::fill(coarse, 0.0F);
    with_sizes(fine_size, coarse_size, [&]<int size, int motions>() {
        add_restricted<size, motions>(*this, fine.data(), nodes, coarse);
    });
}

Coarsening coarsen(const Matrix& A, double largest, const Aggregates& aggregates,
                   const NearNullSpace& motions, const SharedNodes& nodes) {
    const parallel::Team& team = nodes.team();
    parallel::NodeNumbers numbers;
    numbers.rank = team.rank();
    numbers.first = first_nodes(aggregates.count, team);
    Tentative Q = tentative(aggregates, motions, A.size, numbers.begin());
    nodes.add_up(Q.transposed);
    const auto omega = static_cast<float>(damping / largest);
    Prolongation P = with_sizes(A.size, motions.motions, [&]<int size, int n>() {
        Rows rows = smoothed<size, n>(A, Q.transposed, omega, nodes,
                                      CoarseNodes(numbers.begin(), numbers.end(), Q.transposed));
        nodes.add_up(rows);
        const CoarseNodes coarse(numbers.begin(), numbers.end(), rows);
        numbers.global = coarse.global();
        std::ranges::transform(rows.columns, rows.columns.begin(),
                               [&](std::int32_t global) { return coarse.local(global); });
        return Prolongation{size, n, std::move(rows.offsets), std::move(rows.columns),
                            std::move(rows.values)};
    });
    return {std::move(P), std::move(numbers), std::move(Q.motions)};
}

}  // namespace thermocontact::multigrid

#include "multigrid/galerkin.h"

#include "multigrid/blocks.h"
#include "multigrid/columns.h"
#include "multigrid/row_collector.h"

namespace thermocontact::multigrid {
namespace {

/// Rows of blocks by local columns.
struct BlockRows {
    std::vector<std::int32_t> offsets{0}, columns;
    std::vector<float> values;
};

/// ((D / 2 + U) P)^T with D the diagonal blocks of A and U those above it: A P of half the work, as
/// P^T A P = X + X^T with X = P^T (D / 2 + U) P.
template <int size, int motions>
BlockRows half_product(const Matrix& A, const Prolongation& P, std::size_t coarse_count) {
    constexpr int fine = lanes(size), stride = lanes(motions);
    constexpr std::size_t length = std::size_t{size} * stride;
    RowCollector row(coarse_count, length);
    BlockRows result;
    for (std::size_t i = 0; i + 1 < A.offsets.size(); ++i) {
        const auto first = static_cast<std::size_t>(A.offsets[i]);
        for (auto pair = first; pair < static_cast<std::size_t>(A.offsets[i + 1]); ++pair) {
            const float* block = A.block(pair);
            const float factor = pair == first ? 0.5F : 1.0F;
            const auto j = static_cast<std::size_t>(A.columns[pair]);
            const auto last = static_cast<std::size_t>(P.offsets[j + 1]);
            for (auto entry = static_cast<std::size_t>(P.offsets[j]); entry < last; ++entry) {
                const float* from = P.values.data() + entry * length;
                float* to = row.at(P.columns[entry]);
                for (int r = 0; r < size; ++r) {
                    Column<motions> sum = Column<motions>::Zero();
                    for (int s = 0; s < size; ++s) {
                        sum += ConstColumnMap<motions>(column_of<motions>(from, s)) * block[s * fine + r];
                    }
                    ColumnMap<motions>(column_of<motions>(to, r)) += factor * sum;
                }
            }
        }
        row.finish(result.offsets, result.columns, result.values);
    }
    return result;
}

/// X = P^T W, given W^T.
template <int size, int motions>
BlockRows project(const Prolongation& P, const BlockRows& W, std::size_t coarse_count) {
    constexpr int stride = lanes(motions);
    constexpr std::size_t fine_length = std::size_t{size} * stride, length = std::size_t{motions} * stride;
    const Columns of = by_column(P.offsets, P.columns, coarse_count);
    RowCollector row(coarse_count, length);
    BlockRows result;
    for (std::size_t node = 0; node < coarse_count; ++node) {
        const auto end = static_cast<std::size_t>(of.offsets[node + 1]);
        for (auto k = static_cast<std::size_t>(of.offsets[node]); k < end; ++k) {
            const float* left = P.values.data() + static_cast<std::size_t>(of.places[k]) * fine_length;
            const auto i = static_cast<std::size_t>(of.rows[k]);
            const auto last = static_cast<std::size_t>(W.offsets[i + 1]);
            for (auto entry = static_cast<std::size_t>(W.offsets[i]); entry < last; ++entry) {
                const float* right = W.values.data() + entry * fine_length;
                float* to = row.at(W.columns[entry]);
                for (int c = 0; c < motions; ++c) {
                    ColumnMap<motions> sum(column_of<motions>(to, c));
                    for (int r = 0; r < size; ++r) {
                        sum += ConstColumnMap<motions>(column_of<motions>(left, r)) * right[r * stride + c];
                    }
                }
            }
        }
        row.finish(result.offsets, result.columns, result.values);
    }
    return result;
}

/// X + X^T
template <int motions>
Matrix symmetric_sum(const BlockRows& X, std::size_t count) {
    constexpr int stride = lanes(motions);
    constexpr std::size_t length = std::size_t{motions} * stride;
    const Columns of = by_column(X.offsets, X.columns, count);
    RowCollector row(count, length);
    Matrix result{motions, {0}, {}, {}};
    for (std::size_t i = 0; i < count; ++i) {
        row.at(static_cast<std::int32_t>(i));
        const auto last = static_cast<std::size_t>(X.offsets[i + 1]);
        for (auto entry = static_cast<std::size_t>(X.offsets[i]); entry < last; ++entry) {
            if (X.columns[entry] >= static_cast<std::int32_t>(i)) {
                float* to = row.at(X.columns[entry]);
                const float* from = X.values.data() + entry * length;
                for (std::size_t k = 0; k < length; ++k) {
                    to[k] += from[k];
                }
            }
        }
        const auto end = static_cast<std::size_t>(of.offsets[i + 1]);
        for (auto k = static_cast<std::size_t>(of.offsets[i]); k < end; ++k) {
            if (of.rows[k] >= static_cast<std::int32_t>(i)) {
                float* to = row.at(of.rows[k]);
                const float* from = X.values.data() + static_cast<std::size_t>(of.places[k]) * length;
                for (int r = 0; r < motions; ++r) {
                    for (int c = 0; c < motions; ++c) {
                        to[c * stride + r] += from[r * stride + c];
                    }
                }
            }
        }
        row.finish(result.offsets, result.columns, result.values);
    }
    return result;
}

}  // namespace

Matrix galerkin(const Matrix& A, const Prolongation& P, std::size_t coarse_count) {
    return with_sizes(A.size, P.coarse_size, [&]<int size, int motions>() {
        const BlockRows W = half_product<size, motions>(A, P, coarse_count);
        const BlockRows X = project<size, motions>(P, W, coarse_count);
        return symmetric_sum<motions>(X, coarse_count);
    });
}

}  // namespace thermocontact::multigrid

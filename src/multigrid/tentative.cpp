#include "multigrid/tentative.h"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

constexpr double dependent = 1e-5;  ///< what is left of a motion, of its length, that the others explain

using Motions = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// B = Q R by Gram and Schmidt, twice; motions that depend on those before them, as rotations of a single
/// node do, become zero in Q.
void orthonormalise(Motions& B, Motions& R) {
    R.setZero();
    for (Eigen::Index c = 0; c < B.cols(); ++c) {
        const double before = B.col(c).norm();
        for (int turn = 0; turn < 2; ++turn) {
            for (Eigen::Index k = 0; k < c; ++k) {
                const double part = B.col(k).dot(B.col(c));
                R(k, c) += part;
                B.col(c) -= part * B.col(k);
            }
        }
        const double rest = B.col(c).norm();
        if (rest > dependent * before) {
            R(c, c) = rest;
            B.col(c) /= rest;
        } else {
            B.col(c).setZero();
        }
    }
}

/// Nodes of each aggregate, compressed.
struct Members {
    std::vector<std::int32_t> offsets, nodes;
};

Members members(const Aggregates& aggregates) {
    Members result;
    result.offsets.assign(static_cast<std::size_t>(aggregates.count) + 1, 0);
    for (const std::int32_t a : aggregates.of) {
        if (a >= 0) {
            ++result.offsets[static_cast<std::size_t>(a) + 1];
        }
    }
    std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
    result.nodes.resize(static_cast<std::size_t>(result.offsets.back()));
    auto next = result.offsets;
    for (std::size_t node = 0; node < aggregates.of.size(); ++node) {
        if (const std::int32_t a = aggregates.of[node]; a >= 0) {
            result.nodes[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] =
                static_cast<std::int32_t>(node);
        }
    }
    return result;
}

}  // namespace

Tentative tentative(const Aggregates& aggregates, const NearNullSpace& motions, int size,
                    std::int32_t first_coarse) {
    const auto s = static_cast<std::size_t>(size), m = static_cast<std::size_t>(motions.motions);
    const auto stride = static_cast<std::size_t>(lanes(motions.motions));
    Rows rows{s * stride, {0}, {}, {}};
    std::vector<float> blocks(aggregates.of.size() * rows.length, 0.0F);
    const Members in = members(aggregates);
    Motions B, R(motions.motions, motions.motions);
    std::vector<double> coarse_motions;
    coarse_motions.resize(static_cast<std::size_t>(aggregates.count) * m * m);
    for (std::size_t a = 0; a + 1 < in.offsets.size(); ++a) {
        const auto begin = static_cast<std::size_t>(in.offsets[a]);
        const auto count = static_cast<std::size_t>(in.offsets[a + 1]) - begin;
        B.resize(static_cast<Eigen::Index>(count * s), motions.motions);
        for (std::size_t k = 0; k < count; ++k) {
            const auto node = static_cast<std::size_t>(in.nodes[begin + k]);
            std::copy_n(motions.values.data() + node * s * m, s * m, B.data() + k * s * m);
        }
        orthonormalise(B, R);
        std::copy_n(R.data(), m * m, coarse_motions.data() + a * m * m);
        for (std::size_t k = 0; k < count; ++k) {
            float* block = blocks.data() + static_cast<std::size_t>(in.nodes[begin + k]) * rows.length;
            for (std::size_t r = 0; r < s; ++r) {
                for (std::size_t c = 0; c < m; ++c) {
                    block[r * stride + c] = static_cast<float>(B.data()[(k * s + r) * m + c]);
                }
            }
        }
    }
    for (std::size_t node = 0; node < aggregates.of.size(); ++node) {
        if (aggregates.of[node] >= 0) {
            rows.columns.push_back(first_coarse + aggregates.of[node]);
            const float* block = blocks.data() + node * rows.length;
            rows.values.insert(rows.values.end(), block, block + rows.length);
        }
        rows.offsets.push_back(static_cast<std::int32_t>(rows.columns.size()));
    }
    return {std::move(rows), {motions.motions, std::move(coarse_motions)}};
}

}  // namespace thermocontact::multigrid

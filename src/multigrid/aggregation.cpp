#include "multigrid/aggregation.h"

#include <algorithm>
#include <span>

namespace thermocontact::multigrid {
namespace {

constexpr float weakest = 0.02F;  ///< theta

/// Strong neighbours of every node and how strong they are.
struct Strong {
    std::vector<std::int32_t> offsets, nodes;
    std::vector<float> strengths;

    std::span<const std::int32_t> around(std::int32_t i) const {
        const auto begin = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i)]);
        return {nodes.data() + begin, nodes.data() + offsets[static_cast<std::size_t>(i) + 1]};
    }

    /// The aggregate of the neighbour that i couples with most, of those in one; or -1.
    std::int32_t most(std::int32_t i, const std::vector<std::int32_t>& aggregates) const {
        float strongest = 0;
        std::int32_t result = -1;
        const auto end = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) + 1]);
        for (auto k = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i)]); k < end; ++k) {
            const std::int32_t theirs = aggregates[static_cast<std::size_t>(nodes[k])];
            if (theirs >= 0 && strengths[k] > strongest) {
                strongest = strengths[k];
                result = theirs;
            }
        }
        return result;
    }
};

float square(const float* block, std::size_t length) {
    float sum = 0;
    for (std::size_t k = 0; k < length; ++k) {
        sum += block[k] * block[k];
    }
    return sum;
}

Strong strong_couplings(const Matrix& A, const std::vector<char>& active) {
    const std::size_t length = A.block_length();
    const auto count = static_cast<std::size_t>(A.node_count());
    const float enough = weakest * weakest * static_cast<float>(A.size);  // |1|^2 of a block is its size
    const auto visit = [&](auto&& strong) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto end = static_cast<std::size_t>(A.offsets[i + 1]);
            for (auto pair = static_cast<std::size_t>(A.offsets[i]) + 1; pair < end; ++pair) {
                const auto j = static_cast<std::size_t>(A.columns[pair]);
                const float strength = square(A.block(pair), length);
                if (active[i] != 0 && active[j] != 0 && strength > enough) {
                    strong(i, j, strength);
                }
            }
        }
    };
    Strong result;
    result.offsets.assign(count + 1, 0);
    visit([&](std::size_t i, std::size_t j, float) {
        ++result.offsets[i + 1];
        ++result.offsets[j + 1];
    });
    for (std::size_t i = 0; i < count; ++i) {
        result.offsets[i + 1] += result.offsets[i];
    }
    auto next = result.offsets;
    result.nodes.resize(static_cast<std::size_t>(result.offsets.back()));
    result.strengths.resize(result.nodes.size());
    visit([&](std::size_t i, std::size_t j, float strength) {
        for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
            const auto place = static_cast<std::size_t>(next[from]++);
            result.nodes[place] = static_cast<std::int32_t>(to);
            result.strengths[place] = strength;
        }
    });
    return result;
}

}  // namespace

Aggregates aggregate(const Matrix& A, const std::vector<char>& active, const SharedNodes& nodes) {
    const Strong strong = strong_couplings(A, active);
    const std::int32_t count = A.node_count();
    Aggregates result{0, std::vector<std::int32_t>(static_cast<std::size_t>(count), -1)};
    const auto of = [&](std::int32_t i) -> std::int32_t& { return result.of[static_cast<std::size_t>(i)]; };
    const auto is_free = [&](std::int32_t i) {
        return of(i) < 0 && nodes.owned(static_cast<std::size_t>(i));
    };
    const auto take_free = [&](std::int32_t root) {
        of(root) = result.count;
        for (const std::int32_t j : strong.around(root)) {
            if (is_free(j)) {
                of(j) = result.count;
            }
        }
        ++result.count;
    };
    for (std::int32_t i = 0; i < count; ++i) {
        const auto around = strong.around(i);
        if (is_free(i) && !around.empty() && std::ranges::all_of(around, is_free)) {
            take_free(i);
        }
    }
    const std::vector<std::int32_t> first = result.of;
    for (std::int32_t i = 0; i < count; ++i) {
        if (is_free(i)) {
            of(i) = strong.most(i, first);
        }
    }
    for (std::int32_t i = 0; i < count; ++i) {
        if (is_free(i) && !strong.around(i).empty()) {
            take_free(i);
        }
    }
    return result;
}

}  // namespace thermocontact::multigrid

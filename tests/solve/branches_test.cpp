#include "solve/branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace thermocontact::solve {
namespace {

/// A complete binary tree of that many levels, numbered so that children come before their parent.
std::vector<std::int32_t> binary_tree(int levels) {
    if (levels == 1) {
        return {-1};
    }
    std::vector<std::int32_t> half = binary_tree(levels - 1), result;
    const auto size = static_cast<std::int32_t>(half.size()), root = 2 * size;
    for (std::int32_t offset : {0, size}) {
        for (const std::int32_t parent : half) {
            result.push_back(parent < 0 ? root : parent + offset);
        }
    }
    result.push_back(-1);
    return result;
}

std::int64_t weight(std::span<const std::int32_t> nodes, std::span<const std::int64_t> weights) {
    return std::accumulate(
        nodes.begin(), nodes.end(), std::int64_t{0},
        [&](std::int64_t sum, std::int32_t node) { return sum + weights[static_cast<std::size_t>(node)]; });
}

/// Every node once, ascending; a parent is in its child's branch or in the trunk.
void expect_branches(const Branches& cut, std::span<const std::int32_t> parents) {
    std::vector<int> place(parents.size(), -2);
    const auto take = [&](const std::vector<std::int32_t>& nodes, int number) {
        EXPECT_TRUE(std::ranges::is_sorted(nodes));
        for (const std::int32_t node : nodes) {
            EXPECT_EQ(place[static_cast<std::size_t>(node)], -2) << "twice";
            place[static_cast<std::size_t>(node)] = number;
        }
    };
    for (std::size_t b = 0; b < cut.branches.size(); ++b) {
        take(cut.branches[b], static_cast<int>(b));
    }
    take(cut.trunk, -1);
    for (std::size_t node = 0; node < parents.size(); ++node) {
        ASSERT_NE(place[node], -2) << "nowhere";
        if (parents[node] >= 0) {
            const int above = place[static_cast<std::size_t>(parents[node])];
            EXPECT_TRUE(above == -1 || above == place[node]);
        }
    }
}

TEST(Branches, ABinaryTreeIsCutIntoItsQuarters) {
    const std::vector<std::int32_t> parents = binary_tree(7);
    const std::vector<std::int64_t> weights(parents.size(), 1);
    const Branches cut = cut_into_branches(parents, weights, 4);
    expect_branches(cut, parents);
    EXPECT_EQ(cut.trunk.size(), 3);
    for (const auto& branch : cut.branches) {
        EXPECT_EQ(branch.size(), 31);
    }
}

TEST(Branches, OneBranchNeedsNoTrunk) {
    const std::vector<std::int32_t> parents = binary_tree(4);
    const Branches cut = cut_into_branches(parents, std::vector<std::int64_t>(parents.size(), 1), 1);
    EXPECT_TRUE(cut.trunk.empty());
    ASSERT_EQ(cut.branches.size(), 1);
    EXPECT_EQ(cut.branches[0].size(), parents.size());
}

/// Many small trees without a common root: packed evenly, none cut.
TEST(Branches, AForestIsPackedEvenly) {
    std::vector<std::int32_t> parents;
    std::vector<std::int64_t> weights;
    for (std::int32_t tree = 0; tree < 40; ++tree) {
        parents.insert(parents.end(), {2 * tree + 1, -1});
        weights.insert(weights.end(), {1 + tree % 5, 2});
    }
    const Branches cut = cut_into_branches(parents, weights, 4);
    expect_branches(cut, parents);
    EXPECT_TRUE(cut.trunk.empty());
    for (const auto& branch : cut.branches) {
        EXPECT_NEAR(static_cast<double>(weight(branch, weights)), 50, 7);  // a tree weighs at most 7
    }
}

/// A path cannot be shared out: cutting ends before most of it is trunk.
TEST(Branches, APathIsLeftAlone) {
    std::vector<std::int32_t> parents(100);
    std::iota(parents.begin(), parents.end(), 1);
    parents.back() = -1;
    const std::vector<std::int64_t> weights(100, 1);
    const Branches cut = cut_into_branches(parents, weights, 4);
    expect_branches(cut, parents);
    EXPECT_LE(cut.trunk.size(), 25);
}

TEST(Branches, NothingToCut) {
    const Branches cut = cut_into_branches({}, {}, 4);
    EXPECT_EQ(cut.branches.size(), 4);
    EXPECT_TRUE(cut.trunk.empty());
}

}  // namespace
}  // namespace thermocontact::solve

#include "solve/branches.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace thermocontact::solve {
namespace {

/// A tree heavier than that many branches should be is cut. Halves of a dissection differ by some per cent.
constexpr double largest_tree = 1.1;
/// A trunk heavier than this share of all is not worth more cuts: nothing is done beside it.
constexpr double largest_trunk = 0.25;

}  // namespace

Branches cut_into_branches(std::span<const std::int32_t> parents, std::span<const std::int64_t> weights,
                           int count) {
    const std::size_t n = parents.size();
    std::vector<std::int64_t> tree(weights.begin(), weights.end());  // weight of a node and all below
    std::vector<std::vector<std::int32_t>> children(n);
    using Tree = std::pair<std::int64_t, std::int32_t>;
    std::priority_queue<Tree> trees;  // the heaviest first
    for (std::size_t node = 0; node < n; ++node) {
        if (const std::int32_t parent = parents[node]; parent >= 0) {
            tree[static_cast<std::size_t>(parent)] += tree[node];
            children[static_cast<std::size_t>(parent)].push_back(static_cast<std::int32_t>(node));
        } else {
            trees.emplace(tree[node], static_cast<std::int32_t>(node));
        }
    }
    const auto total = static_cast<double>(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}));
    std::vector<int> place(n, -1);  // branch of a tree's root; -1: by its parent, or trunk
    Branches result{std::vector<std::vector<std::int32_t>>(static_cast<std::size_t>(count)), {}};
    std::vector<char> in_trunk(n, 0);
    double trunk = 0;
    while (count > 1 && !trees.empty()) {
        const auto [weight, root] = trees.top();
        const auto own = static_cast<double>(weights[static_cast<std::size_t>(root)]);
        if (static_cast<double>(weight) <= largest_tree * total / count ||
            trunk + own > largest_trunk * total) {
            break;
        }
        trees.pop();
        in_trunk[static_cast<std::size_t>(root)] = 1;
        trunk += own;
        for (const std::int32_t child : children[static_cast<std::size_t>(root)]) {
            trees.emplace(tree[static_cast<std::size_t>(child)], child);
        }
    }
    std::vector<std::int64_t> filled(static_cast<std::size_t>(count), 0);
    for (; !trees.empty(); trees.pop()) {
        const auto lightest = std::ranges::min_element(filled);
        *lightest += trees.top().first;
        place[static_cast<std::size_t>(trees.top().second)] = static_cast<int>(lightest - filled.begin());
    }
    for (std::size_t node = n; node-- > 0;) {  // parents first
        if (in_trunk[node] == 0 && place[node] < 0) {
            place[node] = place[static_cast<std::size_t>(parents[node])];
        }
    }
    for (std::size_t node = 0; node < n; ++node) {
        auto& target =
            in_trunk[node] != 0 ? result.trunk : result.branches[static_cast<std::size_t>(place[node])];
        target.push_back(static_cast<std::int32_t>(node));
    }
    return result;
}

}  // namespace thermocontact::solve

/// A forest cut into branches of about equal weight, which can be worked on at the same time, and the trunk
/// above them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace thermocontact::solve {

struct Branches {
    /// [branches]: trees each, their nodes ascending. Nodes of different branches are not related.
    std::vector<std::vector<std::int32_t>> branches;
    std::vector<std::int32_t> trunk;  ///< ancestors of several trees, ascending
};

/// `parents` [nodes]: above the node (a larger number), or -1; `weights` [nodes]. Nodes of the heaviest trees
/// go into the trunk until the trees fill `count` branches evenly.
Branches cut_into_branches(std::span<const std::int32_t> parents, std::span<const std::int64_t> weights,
                           int count);

}  // namespace thermocontact::solve

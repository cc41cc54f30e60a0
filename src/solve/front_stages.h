/// Who makes which fronts, where equal ones are made once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solve/branches.h"
#include "solve/front_tree.h"

namespace thermocontact::solve {

/// First ones of equal fronts, ascending in each list: the common ones come before all, then the branches
/// beside each other, then the trunk.
struct FrontStages {
    std::vector<std::int32_t>
        common;  ///< of which more than one branch, or a branch and the trunk, has an equal
    std::vector<std::vector<std::int32_t>> branches;
    std::vector<std::int32_t> trunk;
};

/// `first` [supernodes] as equal_fronts has it; `cuts` of some of the supernodes. What a front needs is made
/// in its own list before it, or in an earlier stage.
FrontStages front_stages(const FrontTree& tree, std::span<const std::int32_t> first, const Branches& cuts);

}  // namespace thermocontact::solve

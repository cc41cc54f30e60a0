#include "solve/front_stages.h"

#include <cstddef>

namespace thermocontact::solve {
namespace {

constexpr std::int32_t nobody = -1, several = -2;

}  // namespace

FrontStages front_stages(const FrontTree& tree, std::span<const std::int32_t> first, const Branches& cuts) {
    const auto trunk = static_cast<std::int32_t>(cuts.branches.size());
    std::vector<std::int32_t> maker(first.size(), nobody);  // of the first one of equal fronts
    const auto claim = [&](std::span<const std::int32_t> fronts, std::int32_t owner) {
        for (const std::int32_t front : fronts) {
            std::int32_t& now = maker[static_cast<std::size_t>(first[static_cast<std::size_t>(front)])];
            now = now == nobody || now == owner ? owner : several;
        }
    };
    for (std::int32_t branch = 0; branch < trunk; ++branch) {
        claim(cuts.branches[static_cast<std::size_t>(branch)], branch);
    }
    claim(cuts.trunk, trunk);
    for (std::size_t s = first.size(); s-- > 0;) {  // parents first: what they need is needed as early
        if (maker[s] == several) {
            for (const std::int32_t child : tree.children(s)) {
                maker[static_cast<std::size_t>(first[static_cast<std::size_t>(child)])] = several;
            }
        }
    }
    FrontStages result{{}, std::vector<std::vector<std::int32_t>>(cuts.branches.size()), {}};
    for (std::size_t s = 0; s < first.size(); ++s) {
        const auto front = static_cast<std::int32_t>(s);
        if (maker[s] == several) {
            result.common.push_back(front);
        } else if (maker[s] == trunk) {
            result.trunk.push_back(front);
        } else if (maker[s] != nobody) {
            result.branches[static_cast<std::size_t>(maker[s])].push_back(front);
        }
    }
    return result;
}

}  // namespace thermocontact::solve

#include "plan/grading.h"

#include <algorithm>
#include <array>
#include <string>

#include "plan/discretisation.h"

namespace thermocontact::plan {
namespace {

/// What happens at a side.
struct Condition {
    std::string mechanical = "free", thermal = "free";
    bool symmetric = false;

    bool operator==(const Condition&) const = default;
};

Condition condition_of(const scene::Scene& scene, const std::string& side) {
    Condition result;
    const auto found = scene.boundaries.find(side);
    if (found == scene.boundaries.end()) {
        return result;
    }
    const scene::Boundary& boundary = found->second;
    const auto held =
        std::ranges::count_if(boundary.displacement, &std::optional<scene::Expression>::has_value);
    if (boundary.contact) {
        result.mechanical = boundary.contact->compliance ? "touched" : "free";
        result.thermal = boundary.contact->conductance ? "touched" : "free";
    }
    if (held > 0) {
        result.mechanical = held == scene.dimension ? "held" : "guided";
    }
    if (boundary.spring) {
        result.mechanical += ", sprung";
    }
    if (boundary.temperature) {
        result.thermal = "held";
    }
    result.symmetric = result.mechanical == "guided" && result.thermal == "free";
    return result;
}

}  // namespace

std::vector<scene::Grading> graded(const scene::Scene& scene, double ratio) {
    if (scene.mesh.file) {
        return {};
    }
    const auto axes = static_cast<std::size_t>(scene.dimension);
    std::vector<scene::Grading> result(axes);
    std::vector<Condition> conditions;
    for (std::size_t side = 0; side < 2 * axes; ++side) {
        conditions.push_back(condition_of(scene, side_names[side]));
    }
    const auto ratio_at = [&](std::size_t side) -> double& {
        scene::Grading& axis = result[side / 2];
        return side % 2 == 0 ? axis.lower : axis.upper;
    };
    for (std::size_t a = 0; a < 2 * axes; ++a) {
        for (std::size_t b = 0; b < 2 * axes; ++b) {
            const bool meet = a / 2 != b / 2;
            if (meet && !conditions[a].symmetric && !conditions[b].symmetric &&
                conditions[a] != conditions[b] && scene.mesh.cells[a / 2] > 1) {
                ratio_at(a) = ratio;
            }
        }
    }
    return steepest(result) > 1 ? result : std::vector<scene::Grading>{};
}

}  // namespace thermocontact::plan

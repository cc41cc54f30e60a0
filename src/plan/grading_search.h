/// Which sides a mesh is best graded toward, and how steeply.
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::plan {

/// The ratio to begin with, and the factor from one ratio to the next steeper one.
inline constexpr double gentle_grading = 4;

/// First `begin`, then side by side, where that is graded at all, more steeply as long as that lowers the
/// price visibly. `price` tries a grading; none is tried once `enough` says so, or if `begin` is empty.
void search_grading(std::vector<scene::Grading> begin,
                    const std::function<double(const std::vector<scene::Grading>&)>& price,
                    const std::function<bool()>& enough);

}  // namespace thermocontact::plan

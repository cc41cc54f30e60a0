/// Which sides a mesh is best graded toward, and how steeply.
#pragma once

#include <functional>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::plan {

/// First grades toward all corners (graded()) by a small ratio, then side by side, more steeply as long as
/// that lowers the price visibly. `price` tries a grading; none is tried once `enough` says so.
void search_grading(const scene::Scene& scene,
                    const std::function<double(const std::vector<scene::Grading>&)>& price,
                    const std::function<bool()>& enough);

}  // namespace thermocontact::plan

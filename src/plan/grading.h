/// Graded meshes that are worth a try.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace thermocontact::plan {

/// Cells that are smaller by `ratio` at the two sides of each corner of a rectangle (edge of a box) where
/// what holds, touches, heats or cools the body changes: there strains and heat flows are large or infinite.
/// A side that is a plane of symmetry changes nothing. [d]; empty where there is no such corner, or no shape.
std::vector<scene::Grading> graded(const scene::Scene& scene, double ratio);

}  // namespace thermocontact::plan

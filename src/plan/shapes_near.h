/// Gradings of meshes as fine as a choice: coarse ones do not show which sides will matter.
#pragma once

#include "plan/study.h"

namespace thermocontact::plan {

/// Adds kinds of meshes graded more steeply than that of `finest`, side by side (grading_search.h), each from
/// a ladder of pilots up to about its scale, in its steps, as long as `seconds` allow.
void learn_gradings(Study& study, const Pilot& finest, double seconds);

/// A model of one kind of mesh, in the place of what was known of it, from a ladder of pilots near a choice.
void take_near(Study& study, const std::vector<const Pilot*>& pilots, ErrorCurve error);

}  // namespace thermocontact::plan

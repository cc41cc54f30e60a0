/// Where a field is going: the polynomial through its values at the ends of the last equal steps. A strategy
/// that corrects a start value (solve::Strategy::starts_matter) has little to correct when steps begin from
/// there.
#pragma once

#include <optional>

#include "fem/block_rows.h"
#include "march/state.h"
#include "march/step_rule.h"

namespace thermocontact::march {

/// What a stage value is expected to be a sum of.
struct CourseWeights {
    double latest = 0;                 ///< of the value where the step begins
    double before[course_order] = {};  ///< of those before, as in PastValues
    int count = 0;                     ///< of the latter; the others may be anything
};

/// Nothing where there is no course: at first, and where no values were kept. As many steps count as were
/// equal and have left values: before a restart another strategy may have kept none.
std::optional<CourseWeights> course_weights(const StepRule& rule, const State& state, const PastValues& past);

/// The expected stage values [nodes][components] of the nodes in the range, from `y`, where the step begins;
/// not of unknowns that are `fixed`.
void follow_course(const CourseWeights& weights, const Nodal& y, const PastValues& past,
                   const std::vector<char>& fixed, fem::NodeRange range, int components, Nodal& stage);

/// Moves `y` to the end of a step, where it is y_new, and keeps what it was. `y_new` is scratch afterwards.
void renew_course(PastValues& past, Nodal& y, Nodal& y_new);

/// How many equal steps there were, that of `rule` the last.
int even_steps(const StepRule& rule, const State& state);

}  // namespace thermocontact::march

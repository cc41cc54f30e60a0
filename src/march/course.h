/// Where a field is going: the polynomial through its values at the ends of the last equal steps, by their
/// backward differences. A strategy that corrects a start value (solve::Strategy::starts_matter) has little
/// to correct when steps begin from there.
#pragma once

#include "march/state.h"
#include "march/step_rule.h"

namespace thermocontact::march {

/// Differences kept, and at most as many as there were equal steps in force.
constexpr int course_order = 3;

/// Moves the stage value [nodes][components] at the unknowns that are not `fixed` from `y`, where the step
/// begins, to where the course of the state's last steps puts it. Does nothing where there is no course.
void follow_course(const StepRule& rule, const State& state, const Nodal& y, const Nodal& differences,
                   const std::vector<char>& fixed, Nodal& stage);

/// Differences [nodes][components][order] at the end of the step from y to y_new; `state` is that at its
/// begin.
void renew_course(const StepRule& rule, const State& state, const Nodal& y, const Nodal& y_new,
                  Nodal& differences);

/// How many equal steps there were, that of `rule` the last.
int even_steps(const StepRule& rule, const State& state);

}  // namespace thermocontact::march

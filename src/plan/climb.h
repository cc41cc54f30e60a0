/// Pilots refined in one direction until the error left is small enough, or the next one costs too much.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "plan/bench.h"
#include "plan/difference.h"
#include "plan/error_curve.h"

namespace thermocontact::plan {

struct Climb {
    /// Level 0, 1, ...; nothing beyond the last.
    std::function<std::optional<Discretisation>(int level)> level;
    std::function<double(const Discretisation&)> knob;
    std::vector<double> highest_orders;  ///< [components] of theory
    double growth;                       ///< of a pilot's time, from level to level
    double goal;                         ///< relative error to be left in the finest pilot
    double seconds;                      ///< of processor time that a further pilot may take
};

struct Climbed {
    std::vector<const Pilot*> pilots;  ///< one after another, coarse to fine; at least three, or none
    ErrorCurve error;
};

/// Of pilots refined in one direction alone, coarse to fine.
ErrorCurve error_of(const std::vector<const Pilot*>& pilots, Comparison& comparison,
                    const std::function<double(const Discretisation&)>& knob,
                    const std::vector<double>& highest_orders, const std::vector<double>& lowest_orders = {});

/// Where a pilot fails, the ladder begins anew with the next finer one, as long as that is not foreseen to
/// take longer than a further pilot may.
Climbed climb(Bench& bench, Comparison& comparison, const Climb& how);

/// The errors of a ladder from what its runs differ by from the finest of `reference`, and what is left in
/// that.
ErrorCurve error_against(const Climbed& climbed, const Climbed& reference, Comparison& comparison,
                         const Climb& how);

/// Energy that a scheme may dissipate, of the largest there is, before its steps count as too long for what
/// moves: motions that all runs damp are missing in all of them, and these agree on what is wrong.
inline constexpr double most_damped = 0.1;

}  // namespace thermocontact::plan

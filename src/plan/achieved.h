/// What became of a plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/bench.h"
#include "plan/planner.h"

namespace thermocontact::plan {

/// The error of a run is estimated from what it differs by from a pilot of half the cells and half the steps,
/// or, where these cannot be halved, of twice as many: the models say what the run errs by itself, of that.
struct Achieved {
    std::vector<double> errors;  ///< [components], relative, estimated
    double error;                ///< the largest
    bool halved;                 ///< by a pilot of half the cells and steps, not of twice as many
    /// Where that is more than was asked for: what would meet it, from models that this run has corrected.
    std::optional<Option> instead = {};
    std::vector<std::string> settings = {};  ///< of that
    Models models = {};                      ///< the corrected ones
};

/// Runs the pilot if the plan has not; nothing where it fails.
std::optional<Achieved> achieved(const Plan& plan, Bench& bench, const Pilot& run);

/// The plan of what meets what this one missed; nothing where it missed nothing, or that is foreseen to take
/// more than `seconds`.
std::optional<Plan> after_miss(const Plan& plan, const Achieved& achieved, double seconds);

}  // namespace thermocontact::plan

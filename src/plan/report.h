/// A plan as people and programs read it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "plan/achieved.h"
#include "plan/planner.h"

namespace thermocontact::plan {

/// Lines: what was asked, what is chosen with its error and time, the next offers. `scene` names the file.
std::string text(const Plan& plan, const std::string& scene);

/// Predicted against achieved, of a run that took so many seconds; no `achieved`: it could not be judged.
std::string text(const Plan& plan, double seconds, const std::optional<Achieved>& achieved);

/// Both for summary.json.
nlohmann::ordered_json to_json(const Plan& plan, double seconds, const std::optional<Achieved>& achieved);

/// The words with ", " between them.
std::string list(const std::vector<std::string>& words);

/// The component and source that errs most: "temperature in space".
std::string largest_source(const std::vector<std::string>& components, const Option& option);

}  // namespace thermocontact::plan

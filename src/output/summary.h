/// summary.json (INTERFACE.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "output/results.h"

namespace thermocontact::output {

nlohmann::ordered_json summary(const scene::Scene& scene, march::Simulation& simulation,
                               const std::string& status, const std::string& reason, const Seconds& seconds,
                               const std::vector<BalanceCondition>& conditions);

/// What `final.contact` has of one boundary.
march::Record contact_values(const model::ContactMeasures& measures);

/// "0.1.0 (FFCx 0.5.0, UFL 2022.2.0; forms 0123456789abcdef)".
std::string version_text();

}  // namespace thermocontact::output

/// What is left of a run's digits, and the warning where that is little.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "march/simulation.h"

namespace thermocontact::output {

/// Of one balance, in the last step; empty where nothing tells (no step solved, or it would take long).
struct BalanceCondition {
    std::string balance;  ///< "momentum", "heat"
    std::optional<solve::Condition> condition;
};

/// A few solves with the last system of each balance. Every process must call.
std::vector<BalanceCondition> conditions(march::Simulation& simulation);

/// The summary's `conditioning`: `condition` of all unknowns, `contact_condition` of the condensed ones,
/// `digits` that the former leaves; null where nothing is known, the second by strategy "newton-krylov".
nlohmann::ordered_json to_json(const std::vector<BalanceCondition>& conditions);

/// What to warn of: a balance with fewer than six digits; empty where there is none.
std::string warning(const std::vector<BalanceCondition>& conditions);

/// Also of balances that some step kept only to more than 1e-8 of their terms: with the default tolerance
/// such a step is not accepted (march/audit_limit.h), a looser one may let it pass.
std::string warning(const std::vector<BalanceCondition>& conditions, const march::Totals& totals);

}  // namespace thermocontact::output

#include "output/conditioning.h"

#include <utility>

#include "number.h"

namespace thermocontact::output {
namespace {

constexpr double enough_digits = 6;
constexpr double largest_audit = 1e-8;

}  // namespace

std::vector<BalanceCondition> conditions(march::Simulation& simulation) {
    std::vector<BalanceCondition> result;
    for (const march::Balance* balance : simulation.balances()) {
        result.push_back({balance->name(), balance->condition()});
    }
    return result;
}

nlohmann::ordered_json to_json(const std::vector<BalanceCondition>& conditions) {
    nlohmann::ordered_json result = nlohmann::ordered_json::object();
    for (const auto& [balance, condition] : conditions) {
        result[balance] = nullptr;
        if (condition) {
            const nlohmann::ordered_json contact = condition->contact
                                                       ? nlohmann::ordered_json(*condition->contact)
                                                       : nlohmann::ordered_json(nullptr);
            result[balance] = {{"condition", condition->system},
                               {"contact_condition", contact},
                               {"digits", solve::digits_left(condition->system)}};
        }
    }
    return result;
}

std::string warning(const std::vector<BalanceCondition>& conditions) {
    std::string text;
    for (const auto& [balance, condition] : conditions) {
        if (condition && solve::digits_left(condition->system) < enough_digits) {
            text += (text.empty() ? "" : "; ") + balance + " balance: rounding leaves about " +
                    std::to_string(static_cast<int>(solve::digits_left(condition->system))) +
                    " digits of the last step's solution (condition " + short_text(condition->system) + ")";
        }
    }
    return text.empty() ? text
                        : text + "; the body is held by little, or its parameters differ by too many decades";
}

std::string warning(const std::vector<BalanceCondition>& conditions, const march::Totals& totals) {
    std::string text = warning(conditions);
    for (const auto& [name, residual] :
         {std::pair("energy", totals.energy_residual), std::pair("force", totals.force_residual),
          std::pair("heat", totals.heat_residual)}) {
        if (!(residual <= largest_audit)) {
            text += (text.empty() ? "" : "; ") + std::string(name) + " balance: some step keeps it only to " +
                    short_text(residual) +
                    " of its terms; the last bits of the unknowns are worth that, or the step is not solved";
        }
    }
    return text;
}

}  // namespace thermocontact::output

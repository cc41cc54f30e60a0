/// What a user asks of a plan.
#pragma once

#include <optional>

#include "plan/quantity.h"

namespace thermocontact::plan {

/// At least one of accuracy and budget is there; with both, the budget bounds what the accuracy may cost.
struct Request {
    std::optional<double> accuracy;  ///< relative error (difference.h), between 0 and 1
    std::optional<double> budget;    ///< s
    Quantity of = Quantity::norms;
};

}  // namespace thermocontact::plan

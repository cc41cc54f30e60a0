/// The tables behind dictionary.h.
#pragma once

#include <vector>

#include "output/dictionary.h"

namespace thermocontact::output {

std::vector<Quantity> history_columns();
std::vector<Quantity> steps_columns();
std::vector<Quantity> body_fields();
std::vector<Quantity> contact_fields();
std::vector<Quantity> summary_entries();
std::vector<Quantity> summary_opened_entries();

}  // namespace thermocontact::output

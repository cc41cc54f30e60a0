#include "march/audit_limit.h"

#include "number.h"

namespace thermocontact::march {

std::string unkept_text(const std::string& which, double residual, double limit, std::vector<Magnitude> terms,
                        const std::string& unit) {
    std::ranges::sort(terms, std::ranges::greater{}, [](const Magnitude& term) {
        return std::isnan(term.value) ? std::numeric_limits<double>::infinity() : term.value;
    });
    const auto sized = [&](const Magnitude& term) {
        return std::string(term.of) + ", " + short_text(term.value) + " " + unit;
    };
    const double digits = std::isfinite(residual) ? std::max(0.0, -std::log10(residual)) : 0.0;
    return "the solution keeps the balance of " + which + " only to " + short_text(residual) +
           " of its terms (" + short_text(limit) + " are allowed), to " +
           std::to_string(static_cast<int>(digits)) + " digits; the largest of them are " + sized(terms[0]) +
           ", and " + sized(terms[1]) +
           "; try more time.steps, or parameters of these that differ by fewer decades";
}

}  // namespace thermocontact::march

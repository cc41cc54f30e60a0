#include "plan/achieved.h"

#include <algorithm>
namespace thermocontact::plan {

std::optional<Achieved> achieved(const Plan& plan, Bench& bench, const Pilot& run) {
    Comparison comparison(bench.scene(), plan.request.of);
    const Option fine = *plan.chosen;
    const Option coarse = assess(plan.models, coarser_in_time(coarser_in_space(fine.discretisation)));
    const Pilot* pilot = bench.run(coarse.discretisation);
    if (pilot == nullptr) {
        return std::nullopt;
    }
    const std::vector<double> apart = comparison.difference(*pilot, run), size = comparison.size(run);
    Achieved result{{}, 0};
    for (std::size_t c = 0; c < size.size(); ++c) {
        const Sum sum = plan.models.sum;
        const double own = combined(fine.space[c], fine.time[c], sum);
        const double more = combined(coarse.space[c] - fine.space[c], coarse.time[c] - fine.time[c], sum);
        const double relative = size[c] > 0 ? apart[c] / size[c] : 0.0;
        result.errors.push_back(more > 0 ? relative * own / more : own);
    }
    result.error = *std::ranges::max_element(result.errors);
    return result;
}

}  // namespace thermocontact::plan

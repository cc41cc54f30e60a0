#include "plan/grading_search.h"

namespace thermocontact::plan {
namespace {

constexpr double steepest_ratio = 4096;
constexpr double worth_it = 0.95;  ///< of the price, that a steeper grading leaves at most

double& ratio_at(std::vector<scene::Grading>& grading, std::size_t side) {
    scene::Grading& axis = grading[side / 2];
    return side % 2 == 0 ? axis.lower : axis.upper;
}

}  // namespace

void search_grading(std::vector<scene::Grading> begin,
                    const std::function<double(const std::vector<scene::Grading>&)>& price,
                    const std::function<bool()>& enough) {
    if (begin.empty() || enough()) {
        return;
    }
    std::vector<scene::Grading> best = std::move(begin);
    double least = price(best);
    for (bool gained = true; gained;) {
        gained = false;
        for (std::size_t side = 0; side < 2 * best.size(); ++side) {
            std::vector<scene::Grading> steeper = best;
            double& ratio = ratio_at(steeper, side);
            if (ratio == 1 || ratio >= steepest_ratio) {
                continue;
            }
            if (enough()) {
                return;
            }
            ratio *= gentle_grading;
            if (const double found = price(steeper); found < worth_it * least) {
                best = steeper, least = found, gained = true;
            }
        }
    }
}

}  // namespace thermocontact::plan

#include "plan/shapes_near.h"

#include <algorithm>
#include <limits>

#include "plan/climb.h"
#include "plan/grading_search.h"
#include "plan/models.h"
#include "plan/orders.h"

namespace thermocontact::plan {
namespace {

constexpr int rungs = 3;                ///< the fewest that tell an order
constexpr double seconds_a_rung = 1.4;  ///< of the finest rung's, that all take: a quarter of the cells each

/// Up to the scale of `finest`, coarse to fine; empty where one fails or there are too few.
std::vector<const Pilot*> ladder_below(Bench& bench, Discretisation finest) {
    std::vector<const Pilot*> pilots;
    for (int rung = 0; rung < rungs; ++rung) {
        const Pilot* pilot = bench.run(finest);
        if (pilot == nullptr || (rung + 1 < rungs && finest.scale == 1)) {
            return {};
        }
        pilots.insert(pilots.begin(), pilot);
        finest = coarser_in_space(finest);
    }
    return pilots;
}

}  // namespace

void take_near(Study& study, const std::vector<const Pilot*>& pilots, ErrorCurve error) {
    const Discretisation& finest = pilots.back()->discretisation;
    SpaceModel model = space_model(refined_axes(study.bench->scene()), pilots, std::move(error));
    model.near = 1.0 / finest.scale;
    std::erase_if(study.models.spaces, [&](const SpaceModel& other) {
        return kind_of_mesh(other.degree, other.grading, other.stretch) == kind_of_mesh(finest);
    });
    study.models.spaces.push_back(std::move(model));
}

void learn_gradings(Study& study, const Pilot& finest, double seconds) {
    Bench& bench = *study.bench;
    const double begin = bench.seconds();
    const auto knob = [](const Discretisation& choice) { return 1.0 / choice.scale; };
    const auto price = [&](const std::vector<scene::Grading>& grading) {
        Discretisation choice = finest.discretisation;
        choice.grading = grading;
        if (kind_of_mesh(choice) != kind_of_mesh(finest.discretisation)) {
            const std::vector<const Pilot*> pilots = ladder_below(bench, choice);
            if (pilots.empty()) {
                return std::numeric_limits<double>::infinity();
            }
            take_near(study, pilots,
                      error_of(pilots, study.comparison, knob,
                               highest_in_space(study.comparison.components(), choice.degree)));
        }
        return price_of(study, {space_of(study.models, choice)});
    };
    search_grading(finest.discretisation.grading, price, [&] {
        return bench.seconds() - begin + seconds_a_rung * finest.costs.processor > seconds;
    });
}

}  // namespace thermocontact::plan

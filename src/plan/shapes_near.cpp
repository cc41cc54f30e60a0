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

/// The next one that can be halved as often as that takes.
int scale_with_rungs(int scale) {
    constexpr int parts = 1 << (rungs - 1);
    return (scale + parts - 1) / parts * parts;
}

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

/// Two differences tell little of an order, and of many gradings the one whose order is too high by chance
/// would win: none is to be higher than that of the longer ladder that there is, or half of theory's.
std::vector<double> highest_of(const Study& study, const Discretisation& known) {
    const std::vector<double>& orders = space_of(study.models, known).error.orders();
    std::vector<double> result = highest_in_space(study.comparison.components(), known.degree);
    for (std::size_t c = 0; c < result.size(); ++c) {
        result[c] = std::min(result[c], std::max(result[c] / 2, orders[c]));
    }
    return result;
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
    const std::vector<double> highest = highest_of(study, finest.discretisation);
    const auto price = [&](const std::vector<scene::Grading>& grading) {
        Discretisation choice = finest.discretisation;
        choice.grading = grading;
        choice.scale = scale_with_rungs(choice.scale);
        if (kind_of_mesh(choice) != kind_of_mesh(finest.discretisation)) {
            const std::vector<const Pilot*> pilots = ladder_below(bench, choice);
            if (pilots.empty()) {
                return std::numeric_limits<double>::infinity();
            }
            take_near(study, pilots, error_of(pilots, study.comparison, knob, highest));
        }
        return price_of(study, {space_of(study.models, choice)});
    };
    search_grading(finest.discretisation.grading, price, [&] {
        return bench.seconds() - begin + seconds_a_rung * finest.costs.processor > seconds;
    });
}

}  // namespace thermocontact::plan

#include "plan/correction.h"

#include <algorithm>
#include <array>
#include <optional>

#include "plan/models.h"

namespace thermocontact::plan {
namespace {

constexpr double most_correction = 4;

struct Trio {
    Discretisation anchor, in_space, in_time;
};

Trio trio(const Discretisation& anchor) {
    return {anchor, coarser_in_space(anchor), coarser_in_time(anchor)};
}

double seconds_of(const Study& study, const Trio& pilots) {
    double seconds = 0;
    for (const Discretisation& choice : {pilots.anchor, pilots.in_space, pilots.in_time}) {
        seconds += study.bench->has(choice) ? 0 : seconds_without_output(study.models, choice);
    }
    return seconds;
}

/// The finest that the time is enough for.
std::optional<Trio> affordable(const Study& study, const Discretisation& choice, double seconds) {
    const Discretisation half = coarser_in_time(coarser_in_space(choice));
    for (const Discretisation& anchor : {finer(choice, study.models.refinable), choice, half}) {
        if (const Trio pilots = trio(anchor); seconds_of(study, pilots) <= seconds) {
            return pilots;
        }
    }
    return std::nullopt;
}

/// [components]: the difference found of that foreseen.
std::vector<double> ratios(Study& study, const Pilot& coarse, const Pilot& fine) {
    const std::vector<double> found = study.comparison.difference(coarse, fine);
    const std::vector<double> size = study.comparison.size(fine);
    const std::vector<double> foreseen = difference(study.models, coarse.discretisation, fine.discretisation);
    std::vector<double> result;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const double expected = foreseen[c] * size[c];
        result.push_back(expected > 0 && found[c] > 0
                             ? std::clamp(found[c] / expected, 1 / most_correction, most_correction)
                             : 1.0);
    }
    return result;
}

}  // namespace

double seconds_without_output(Models models, const Discretisation& choice) {
    models.frames = 0;
    return assess(models, choice).seconds;
}

bool correct_near(Study& study, const Option& option, double seconds) {
    const std::optional<Trio> near = affordable(study, option.discretisation, seconds);
    if (!near) {
        return false;
    }
    const Pilot* anchor = study.bench->run(near->anchor);
    const Pilot* in_space = study.bench->run(near->in_space);
    const Pilot* in_time = study.bench->run(near->in_time);
    learn_costs(study.models, study.bench->pilots(), refined_axes(study.bench->scene()));
    if (anchor != nullptr && in_space != nullptr && near->in_space.scale != near->anchor.scale) {
        space_of(study.models, near->anchor).error.correct(ratios(study, *in_space, *anchor));
    }
    if (anchor != nullptr && in_time != nullptr && time_knob(near->in_time) != time_knob(near->anchor)) {
        time_of(study.models, near->anchor).error.correct(ratios(study, *in_time, *anchor));
    }
    return true;
}

}  // namespace thermocontact::plan

#include "plan/choice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "march/kept_factors.h"
#include "number.h"

namespace thermocontact::plan {
namespace {

constexpr int most_steps = 10'000'000;
constexpr double smallest_tolerance = 1e-9;
constexpr int bisections = 24;  ///< of 9 decades: to 1e-6 of a knob
constexpr int bisections_of_aim = 16;

/// 1, 2, 4, 6, 8 and from there multiples of 4, a tenth apart: halves and quarters of them are there to be
/// compared with.
int next_count(int count) {
    if (count < 8) {
        return count == 1 ? 2 : count + 2;
    }
    return 4 * std::max(count / 4 + 1, static_cast<int>(std::ceil(count * 1.1 / 4)));
}

std::vector<int> scales(const SpaceModel& space, const Models& models, const Limits& limits) {
    std::vector<int> result{1};
    const auto fits = [&](int scale) {
        return space.unknowns.at(scale) <= limits.unknowns &&
               march::copies_while_made * space.factor_bytes.at(scale) <= models.memory;
    };
    for (int scale = 2; models.refinable && fits(scale); scale = next_count(scale)) {
        result.push_back(scale);
    }
    return result;
}

/// The smallest such count that is not below `least`; large ones, a tenth apart, waste less.
int count_from(double least) {
    int count = 1;
    while (count < least && count < 8) {
        count = next_count(count);
    }
    return count >= least ? count : 4 * static_cast<int>(std::ceil(least / 4));
}

/// The double that these digits are read as, so that what is printed is what is run.
double two_digits_below(double value) {
    const double exponent = std::floor(std::log10(value)) - 1;
    const double digits = std::floor(value / std::pow(10.0, exponent) * (1 + 1e-9));
    return std::strtod((short_text(digits) + "e" + short_text(exponent)).c_str(), nullptr);
}

/// The coarsest stepping whose error beside `space` keeps to `aim`; nothing where none does.
std::optional<Discretisation> coarsest_in_time(const TimeModel& time, const std::vector<double>& space,
                                               double aim, Sum sum) {
    const auto error = [&](double log_knob) {
        return total_error(space, time.error.at(std::exp(log_knob)), sum);
    };
    double fine = std::log(time.stepping.adaptive ? smallest_tolerance : 1.0 / most_steps);
    double coarse = std::log(time.error.coarsest());
    if (error(fine) > aim) {
        return std::nullopt;
    }
    if (error(coarse) <= aim) {
        fine = coarse;
    }
    for (int i = 0; i < bisections && coarse > fine; ++i) {
        const double middle = (fine + coarse) / 2;
        (error(middle) <= aim ? fine : coarse) = middle;
    }
    Discretisation result{0, 0, time.stepping, adaptive_steps, 0, {}};
    if (time.stepping.adaptive) {
        result.tolerance = two_digits_below(std::exp(fine));
    } else {
        result.steps = instants * count_from(std::exp(-fine) / instants * (1 - 1e-9));
    }
    return result;
}

double output_seconds(const Models& models, const SpaceModel& space, const Discretisation& choice) {
    const double rows = models.writing.folder + choice.steps * seconds_of_row;
    if (models.frames == 0) {
        return rows;
    }
    const int frames = 1 + choice.steps / output_every(choice.steps, models.frames);
    return rows + frames * (models.writing.files + writing_per_forming * space.frame.at(choice.scale));
}

}  // namespace

SpaceModel& space_of(Models& models, const Discretisation& choice) {
    return *std::ranges::find_if(models.spaces, [&](const SpaceModel& space) {
        return kind_of_mesh(choice) == kind_of_mesh(space.degree, space.grading, space.stretch);
    });
}

TimeModel& time_of(Models& models, const Discretisation& choice) {
    return *std::ranges::find_if(models.times, [&](const TimeModel& time) {
        return describe(time.stepping) == describe(choice.stepping);
    });
}

const SpaceModel& space_of(const Models& models, const Discretisation& choice) {
    return space_of(const_cast<Models&>(models), choice);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

const TimeModel& time_of(const Models& models, const Discretisation& choice) {
    return time_of(const_cast<Models&>(models), choice);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

double time_knob(const Discretisation& discretisation) {
    return discretisation.stepping.adaptive ? discretisation.tolerance : 1.0 / discretisation.steps;
}

double combined(double space, double time, Sum sum) {
    return sum == Sum::squares ? std::hypot(space, time) : space + time;
}

double total_error(const std::vector<double>& space, const std::vector<double>& time, Sum sum) {
    double largest = 0;
    for (std::size_t c = 0; c < space.size(); ++c) {
        largest = std::max(largest, combined(space[c], time[c], sum));
    }
    return largest;
}

std::vector<double> difference(const Models& models, const Discretisation& coarse,
                               const Discretisation& fine) {
    const std::vector<double> space =
        space_of(models, fine).error.between(1.0 / coarse.scale, 1.0 / fine.scale);
    const std::vector<double> time = time_of(models, fine).error.between(time_knob(coarse), time_knob(fine));
    std::vector<double> result;
    for (std::size_t c = 0; c < space.size(); ++c) {
        result.push_back(combined(space[c], time[c], models.sum));
    }
    return result;
}

double factorisations(const Models& models, const SpaceModel& space, const TimeModel& time,
                      const Discretisation& choice) {
    const std::size_t others = time.factorisations.size() - 1;
    const double bytes = space.factor_bytes.at(choice.scale);
    const std::size_t beside =
        march::factors_beside_another(others, bytes, models.memory - static_cast<double>(others) * bytes);
    return time.factorisations[beside].at(time_knob(choice));
}

Option assess(const Models& models, const Discretisation& discretisation) {
    const SpaceModel& space = space_of(models, discretisation);
    const TimeModel& time = time_of(models, discretisation);
    const double scale = discretisation.scale, knob = time_knob(discretisation);
    Option option{discretisation, space.error.at(1 / scale), time.error.at(knob), 0, 0, 0};
    option.error = total_error(option.space, option.time, models.sum);
    option.unknowns = space.unknowns.at(scale);
    option.seconds = space.setup.at(scale) +
                     factorisations(models, space, time, discretisation) * space.factor.at(scale) +
                     time.attempts.at(knob) * space.step.at(scale) + space.end.at(scale) +
                     output_seconds(models, space, discretisation);
    return option;
}

double seconds_without_output(Models models, const Discretisation& discretisation) {
    models.frames = 0;
    return assess(models, discretisation).seconds;
}

std::optional<Option> cheapest(const Models& models, double aim, const Limits& limits) {
    std::optional<Option> best;
    for (const SpaceModel& space : models.spaces) {
        for (const int scale : scales(space, models, limits)) {
            const std::vector<double> errors = space.error.at(1.0 / scale);
            for (const TimeModel& time : models.times) {
                std::optional<Discretisation> found = coarsest_in_time(time, errors, aim, models.sum);
                if (!found) {
                    continue;
                }
                found->degree = space.degree;
                found->grading = space.grading;
                found->stretch = space.stretch;
                found->scale = scale;
                const Option option = assess(models, *found);
                if (option.seconds <= limits.seconds && (!best || option.seconds < best->seconds)) {
                    best = option;
                }
            }
        }
    }
    return best;
}

std::optional<Option> most_accurate(const Models& models, const Limits& limits) {
    double low = std::log(1e-12), high = std::log(1e3);
    std::optional<Option> best = cheapest(models, std::exp(high), limits);
    for (int i = 0; i < bisections_of_aim && best; ++i) {
        const double middle = (low + high) / 2;
        if (const auto option = cheapest(models, std::exp(middle), limits)) {
            best = option;
            high = middle;
        } else {
            low = middle;
        }
    }
    return best;
}

}  // namespace thermocontact::plan

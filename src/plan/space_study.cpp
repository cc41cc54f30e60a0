#include "plan/space_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"
#include "plan/duration.h"
#include "plan/grading.h"
#include "plan/grading_search.h"
#include "plan/models.h"
#include "plan/orders.h"

namespace thermocontact::plan {
namespace {

constexpr int most_levels = 12;
constexpr double any_time = 1e12;        ///< s
constexpr double share_of_search = 0.3;  ///< of the time of what is asked, to look for a grading
constexpr double longest_search = 60;    ///< s
constexpr int pilots_in_search = 20;     ///< that there is to be time for

/// The stepping that all meshes are compared with.
struct Clock {
    Stepping stepping;
    int steps;
    double tolerance;
};

/// The cheapest that errs little: an error of space that only shows where time is resolved is not to be
/// missed.
Clock clock_of(const Study& study) {
    double few = study.request.accuracy ? *study.request.accuracy / 2 : std::numeric_limits<double>::max();
    for (const TimeModel& time : study.models.times) {
        if (!study.request.accuracy) {
            few = std::min(few, 4 * time.error.largest_at(time.error.finest()));
        }
    }
    const TimeModel* best = nullptr;
    double fewest = 0, knob = 0;
    for (const TimeModel& time : study.models.times) {
        double at = time.error.coarsest();
        while (at > time.error.finest() * 1.01 && time.error.largest_at(at) > few) {
            at /= time.stepping.adaptive ? tolerance_ratio : 2;
        }
        const double cost =
            time.attempts.at(at) * std::max(1.0, time.error.largest_at(at) / std::max(few, 1e-12));
        if (best == nullptr || cost < fewest) {
            best = &time, fewest = cost, knob = at;
        }
    }
    const bool adaptive = best->stepping.adaptive;
    return {best->stepping, adaptive ? adaptive_steps : static_cast<int>(std::lround(1 / knob)),
            adaptive ? knob : 0};
}

/// The kinds of meshes, one after another.
class Meshes {
  public:
    explicit Meshes(Study& study)
        : study_(&study), clock_(clock_of(study)), allowance_(2 * pilot_allowance(study.request)) {}

    void add(int degree, const std::vector<scene::Grading>& grading) {
        const auto level = [&](int number) -> std::optional<Discretisation> {
            return number < most_levels
                       ? std::optional(Discretisation{degree, 1 << number, clock_.stepping, clock_.steps,
                                                      clock_.tolerance, grading})
                       : std::nullopt;
        };
        const auto knob = [](const Discretisation& choice) { return 1.0 / choice.scale; };
        const int d = refined_axes(study_->bench->scene());
        const double growth = std::pow(2.0, 1.2 * d);
        const double seconds = std::min(allowance_, seconds_for_pilots(*study_) / 4);
        const Climb how{level,  knob,         highest_in_space(study_->comparison.components(), degree),
                        growth, study_->goal, seconds};
        const Climbed climbed = climb(*study_->bench, study_->comparison, how);
        if (climbed.pilots.empty()) {
            return;
        }
        study_->models.spaces.push_back(space_model(d, climbed.pilots, climbed.error));
        if (climbed.error.largest_at(climbed.error.finest()) <= study_->goal) {
            // no need to follow what is dearer
            allowance_ = std::min(allowance_, 2 * climbed.pilots.back()->costs.processor);
        }
    }

    /// The mesh of a file.
    void add_only() {
        const Discretisation only{study_->bench->scene().degree, 1, clock_.stepping, clock_.steps,
                                  clock_.tolerance};
        if (const Pilot* pilot = study_->bench->run(only)) {
            study_->models.spaces.push_back(space_model(refined_axes(study_->bench->scene()), {pilot},
                                                        ErrorCurve(study_->comparison.components().size())));
        }
    }

    /// Where what was asked takes long without: of the time that it takes with the best so far, or of the
    /// budget, a share is spent on the search.
    void add_graded() {
        const Request& request = study_->request;
        double seconds = longest_search;
        const auto allow = [&](double of_run) {
            seconds = std::min(
                {seconds, share_of_search * of_run, share_of_search * request.budget.value_or(any_time)});
        };
        if (request.accuracy) {
            allow(price(0, study_->models.spaces.size()));
        } else {
            allow(*request.budget);
        }
        const double begin = study_->bench->seconds();
        const double of_ladder = seconds_of_ladder();
        allowance_ = std::min(allowance_, seconds / pilots_in_search);
        bool tried = false;
        search_grading(
            graded(study_->bench->scene(), gentle_grading),
            [&](const std::vector<scene::Grading>& grading) {
                tried = true;
                const std::size_t before = study_->models.spaces.size();
                add(2, grading);
                const double found = price(before, study_->models.spaces.size());
                if (request.accuracy) {
                    allow(found);
                }
                return found;
            },
            [&] {
                return study_->bench->seconds() - begin + of_ladder > seconds ||
                       of_ladder > seconds_for_pilots(*study_);
            });
        if (!tried && of_ladder > seconds && !graded(study_->bench->scene(), gentle_grading).empty()) {
            study_->remarks.push_back("no graded mesh was tried: three pilots of one take " +
                                      duration_text(of_ladder) + ", more than the search may take");
        }
    }

  private:
    /// Of the fewest pilots that tell an order.
    double seconds_of_ladder() const {
        const Models& models = study_->models;
        double seconds = 0;
        if (std::ranges::find(models.spaces, 2, &SpaceModel::degree) != models.spaces.end()) {
            for (const int scale : {1, 2, 4}) {
                seconds += seconds_without_output(
                    models, {2, scale, clock_.stepping, clock_.steps, clock_.tolerance});
            }
        }
        return seconds;
    }

    /// Of the meshes from `begin` to `end`.
    double price(std::size_t begin, std::size_t end) const {
        const auto at = [&](std::size_t place) {
            return study_->models.spaces.begin() + static_cast<std::ptrdiff_t>(place);
        };
        return price_of(*study_, {at(begin), at(end)});
    }

    Study* study_;
    Clock clock_;
    double allowance_;
};

}  // namespace

void study_space(Study& study) {
    Meshes meshes(study);
    if (!study.models.refinable) {
        meshes.add_only();
    } else {
        meshes.add(1, {});
        meshes.add(2, {});
        meshes.add_graded();
    }
    if (study.models.spaces.empty()) {
        throw NumericsError("plan: no pilot could be run; the last one failed: " + study.bench->failure());
    }
}

}  // namespace thermocontact::plan

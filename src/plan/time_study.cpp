#include "plan/time_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "error.h"
#include "plan/models.h"
#include "plan/orders.h"
#include "plan/report.h"

namespace thermocontact::plan {
namespace {

constexpr int most_levels = 24;
constexpr double hurried = 24;  ///< pilots' time that has to be left for the meshes

const std::vector<Stepping>& steppings() {
    // the one that damps nothing first: others may have to be judged by it
    static const std::vector<Stepping> all = {{"midpoint", false},          {"bdf2", false},
                                              {"generalized-alpha", false}, {"bdf2", true},
                                              {"backward-euler", false},    {"backward-euler", true}};
    return all;
}

/// Cells that the mesh of the pilots has at least: contact is to open and close at many points.
int fewest_cells(int dimension) {
    return dimension == 2 ? 200 : 60;
}

int scale_of(const scene::Scene& scene) {
    if (scene.mesh.file) {
        return 1;
    }
    const std::vector<int> coarsest = coarsest_cells(scene);
    for (int scale = 1;; scale *= 2) {
        const std::vector<int> cells = scaled_cells(coarsest, scene.mesh.cells, scale);
        const double total = std::accumulate(cells.begin(), cells.end(), 1.0, std::multiplies<>());
        if (total >= fewest_cells(scene.dimension)) {
            return scale;
        }
    }
}

Climb climb_of(const Study& study, const Stepping& stepping, double allowance) {
    const scene::Scene& scene = study.bench->scene();
    const int degree = study.models.refinable ? 1 : scene.degree;
    const auto level = [stepping, degree, scale = scale_of(scene)](int number) {
        const int steps = stepping.adaptive ? adaptive_steps : instants << std::min(number, most_levels);
        const double tolerance = first_tolerance / std::pow(tolerance_ratio, number);
        return number < (stepping.adaptive ? most_levels / 4 : most_levels)
                   ? std::optional(Discretisation{degree, scale, stepping, steps, tolerance})
                   : std::nullopt;
    };
    return {level, time_knob,  highest_in_time(study.comparison.components(), stepping),
            2,     study.goal, allowance};
}

}  // namespace

void study_time(Study& study) {
    const bool undamped = is_undamped(study.bench->scene());
    double allowance = pilot_allowance(study.request);
    std::optional<Climbed> faithful;  // where the scene damps nothing: by the scheme that does not, either
    std::vector<std::string> unresolved;
    for (const Stepping& stepping : steppings()) {
        // where material damps, contact starts fast motions on every mesh that only midpoint keeps
        const bool rings = !undamped && stepping.scheme == "midpoint";
        const bool hurry = !study.models.times.empty() && seconds_for_pilots(study) < hurried * allowance;
        if (rings || hurry || !study.bench->can(stepping)) {
            continue;
        }
        const Climb how = climb_of(study, stepping, allowance);
        Climbed climbed = climb(*study.bench, study.comparison, how);
        if (climbed.pilots.empty()) {
            continue;
        }
        if (faithful) {
            climbed.error = error_against(climbed, *faithful, study.comparison, how);
        } else if (undamped && stepping.scheme == "midpoint") {
            faithful = climbed;
        }
        if (climbed.pilots.back()->damped > most_damped) {
            unresolved.push_back(describe(stepping));
            continue;
        }
        study.models.times.push_back(time_model(stepping, climbed));
        if (climbed.error.largest_at(climbed.error.finest()) <= study.goal) {
            // no need to follow what is dearer
            allowance = std::min(allowance, 2 * climbed.pilots.back()->costs.processor);
        }
    }
    if (study.models.times.empty() && unresolved.empty()) {
        throw NumericsError("plan: no pilot could be run; the last one failed: " + study.bench->failure());
    }
    if (!unresolved.empty()) {
        study.remarks.push_back(
            "left out, as more than a tenth of the energy is lost to steps that do not resolve "
            "the motions: " +
            list(unresolved));
    }
}

}  // namespace thermocontact::plan

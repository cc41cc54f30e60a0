#include "plan/proportions.h"

#include <algorithm>
#include <cmath>

#include "plan/climb.h"
#include "plan/models.h"
#include "plan/orders.h"
#include "plan/shapes_near.h"

namespace thermocontact::plan {
namespace {

/// Of the power that the error falls with the number of cells: a bargain is to be a clear one, as another
/// component may err most later on.
constexpr double worth_it = 0.25;

/// A mesh thinned out, and what it errs by, [components].
struct Thinned {
    const Pilot* pilot;
    std::vector<double> errors;
};

std::size_t worst_of(const std::vector<double>& errors) {
    return static_cast<std::size_t>(std::ranges::max_element(errors) - errors.begin());
}

/// With half the cells along `axis`; nothing where that fails.
std::optional<Thinned> thinned(Study& study, const Thinned& from, std::size_t axis) {
    const auto half = halved_along(from.pilot->discretisation, axis, study.bench->scene().mesh.cells);
    const Pilot* pilot = half ? study.bench->run(*half) : nullptr;
    if (pilot == nullptr) {
        return std::nullopt;
    }
    Thinned result{pilot, from.errors};
    const std::vector<double> apart = study.comparison.difference(*pilot, *from.pilot);
    const std::vector<double> size = study.comparison.size(*from.pilot);
    for (std::size_t c = 0; c < apart.size(); ++c) {
        const double relative = size[c] > 0 ? apart[c] / size[c] : 0.0;
        result.errors[c] = combined(result.errors[c], relative, study.models.sum);
    }
    return result;
}

/// As far as it is a bargain.
Thinned thinned_out(Study& study, Thinned best, double growth, double seconds) {
    const double begin = study.bench->seconds();
    const std::size_t axes = study.bench->scene().mesh.cells.size();
    for (std::size_t axis = 0, vain = 0; vain < axes; axis = (axis + 1) % axes) {
        if (study.bench->seconds() - begin + best.pilot->costs.processor > seconds) {
            break;
        }
        if (const std::optional<Thinned> next = thinned(study, best, axis);
            next && next->errors[worst_of(next->errors)] < growth * best.errors[worst_of(best.errors)]) {
            best = *next;
            vain = 0;
        } else {
            ++vain;
        }
    }
    return best;
}

}  // namespace

const Pilot& learn_proportions(Study& study, const std::vector<const Pilot*>& pilots, double seconds) {
    const Discretisation& finest = pilots.back()->discretisation;
    const int axes = refined_axes(study.bench->scene());
    if (finest.grading.empty() || axes < 2) {
        return *pilots.back();  // triangles and tetrahedra are not nested unless all axes are halved
    }
    const ErrorCurve curve = space_of(study.models, finest).error;
    const std::vector<double> errors = curve.at(curve.finest());
    const double order = curve.orders()[worst_of(errors)];
    const Thinned best =
        thinned_out(study, {pilots.back(), errors}, std::pow(2.0, worth_it * order / axes), seconds);
    if (best.pilot == pilots.back()) {
        return *best.pilot;
    }
    const double scales = static_cast<double>(best.pilot->discretisation.scale) / finest.scale;
    const auto knob = [&](const Discretisation& choice) { return 1.0 / (choice.scale * scales); };
    ErrorCurve error =
        error_of(pilots, study.comparison, knob,
                 highest_in_space(study.comparison.components(), finest.degree), curve.orders());
    std::vector<double> factors;
    for (std::size_t c = 0; c < errors.size(); ++c) {
        factors.push_back(errors[c] > 0 ? best.errors[c] / errors[c] : 1.0);
    }
    error.correct(factors);
    take_near(study, {best.pilot}, std::move(error));
    return *best.pilot;
}

}  // namespace thermocontact::plan

#include "solve/secants.h"

namespace thermocontact::solve {
namespace {

/// Of a step that leads back along the last one, so much of it that the updated derivative is nearly
/// singular.
constexpr double singular_share = 0.9;

}  // namespace

NewtonUpdate Secants::improved(NewtonUpdate update) const {
    const auto share = [&](const NewtonUpdate& taken) {
        return taken.step.dot(update.step) / taken.step.squaredNorm();
    };
    for (std::size_t i = 0; i + 1 < taken_.size(); ++i) {
        const double factor = share(taken_[i]);
        update.step += factor * taken_[i + 1].step;
        update.linear += factor * taken_[i + 1].linear;
    }
    if (!taken_.empty()) {
        const double last = share(taken_.back());
        if (last < singular_share) {
            update.step /= 1 - last;
            update.linear /= 1 - last;
        }
    }
    return update;
}

}  // namespace thermocontact::solve

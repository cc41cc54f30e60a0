#include "solve/secants.h"

namespace thermocontact::solve {
namespace {

/// Of a step that leads back along the last one, so much of it that the updated derivative is nearly
/// singular.
constexpr double singular_share = 0.9;

}  // namespace

Eigen::VectorXd Secants::improved(Eigen::VectorXd step) const {
    for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
        step += steps_[i + 1] * (steps_[i].dot(step) / steps_[i].squaredNorm());
    }
    if (!steps_.empty()) {
        const double share = steps_.back().dot(step) / steps_.back().squaredNorm();
        if (share < singular_share) {
            step /= 1 - share;
        }
    }
    return step;
}

}  // namespace thermocontact::solve

/// Simulation: bodies that nothing holds (model/free_motions.h).
#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "model/convection.h"
#include "model/physics.h"

namespace thermocontact::march {

/// Recognises bodies that nothing holds, and ends here those that no contact can hold either: it is closed
/// for a moment.
void Simulation::look_for_free_motions() {
    if (momentum_ && !scene_->material->density) {
        momentum_->balance().look_for_free_motions(
            part_.numbers, scene_->dimension,
            {"inertia", "displacement", "contact is open",
             "prescribe it on a boundary (one component may do), add "
             "material.density, a spring, or contact or friction "
             "that holds it"},
            {}, model::has_spring(*scene_) ? &momentum_->springs() : nullptr);
        double farthest = 0;
        for (const double u : state_.displacement) {
            farthest = std::max(farthest, std::abs(u));
        }
        std::vector<std::vector<double>> gaps;
        for (const auto& surface : surfaces_) {
            gaps.push_back(surface->gap);
            surface->gap.assign(surface->gap.size(), -1 - 2 * farthest);
        }
        momentum_->balance().require_held();
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            surfaces_[i]->gap = std::move(gaps[i]);
        }
    }
    if (heat_ && !scene_->heat->capacity) {
        heat_->balance().look_for_free_motions(
            part_.numbers, 1,
            {"heat capacity", "temperature", "contact conducts no heat",
             "prescribe it on a boundary, or add heat.capacity, convection or contact that conducts"},
            model::convection_nodes(*scene_, part_.mesh, part_.space));
        if (!model::has_conductance(*scene_)) {
            heat_->balance().require_held();
        }
    }
}

/// What has been solved must be the only solution.
void Simulation::require_held() {
    if (momentum_) {
        momentum_->balance().require_held();
    }
    if (heat_) {
        heat_->balance().require_held();
    }
}

}  // namespace thermocontact::march

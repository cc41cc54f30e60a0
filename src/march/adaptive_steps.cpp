/// Simulation: the steps that adapt to time.tolerance (step_control.h).
#include <algorithm>
#include <array>
#include <cmath>

#include "march/simulation.h"

namespace thermocontact::march {

/// The solved step is accepted, or, where its error is to be kept small, judged before; then `parts` has a
/// shorter one next and the state is what it was.
void Simulation::settle(const StepRule& rule, Subdivision& parts, StepCounts& counts) {
    if (!control_) {
        accept(rule, counts);
        parts.accept();
        return;
    }
    const FieldErrors errors = field_errors();
    Attempt attempt = measure(rule, errors);
    if (!rule.has_rate() && parts.reject(Subdivision::most_halvings)) {
        attempt.outcome = Attempt::Outcome::trial;
        counts.attempts.push_back(attempt);
        enlarge_scales(errors);
        return;
    }
    const int order = estimate_order(rule, state_.curvature_lag), size = parts.halvings();
    if (!control_->accepts(attempt.error)) {
        if (parts.reject(control_->down(attempt.error, order))) {
            attempt.outcome = Attempt::Outcome::rejected;
            counts.attempts.push_back(attempt);
            state_.since_change = std::min(state_.since_change, 0);
            return;
        }
        attempt.outcome = Attempt::Outcome::beyond_tolerance;
    }
    accept(rule, counts);
    counts.attempts.push_back(attempt);
    enlarge_scales(errors);
    ++state_.since_change;
    parts.accept(control_->up(attempt.error, order, state_.since_change));
    if (parts.halvings() != size) {
        state_.since_change = 0;
    }
}

void Simulation::enlarge_scales(const FieldErrors& errors) {
    for (const auto& [name, field, scale] : errors) {
        state_.*scale = std::max(state_.*scale, field.size);
    }
}

void Simulation::note_failure(const StepRule& rule, StepCounts& counts) {
    if (control_) {
        counts.attempts.push_back({.end = rule.end, .size = rule.step, .outcome = Attempt::Outcome::failed});
        state_.since_change = StepControl::after_failure;
    }
}

/// Every process calls.
Simulation::FieldErrors Simulation::field_errors() const {
    FieldError displacement, deformation, velocity, temperature;
    if (momentum_) {
        displacement = momentum_->displacement_error(state_);
        deformation = momentum_->deformation_error(state_);
        velocity = momentum_->velocity_error(state_);
    }
    if (heat_) {
        temperature = heat_->temperature_error(state_);
    }
    return {{{"displacement", displacement, &State::displacement_scale},
             {"deformation", deformation, &State::deformation_scale},
             {"velocity", velocity, &State::velocity_scale},
             {"temperature", temperature, &State::temperature_scale}}};
}

/// Throws StepFailure.
Attempt Simulation::measure(const StepRule& rule, const FieldErrors& errors) const {
    Attempt attempt{.end = rule.end, .size = rule.step};
    for (const auto& [name, field, scale] : errors) {
        if (!std::isfinite(field.error) || !std::isfinite(field.size)) {
            throw StepFailure(std::string("the estimate of the ") + name + "'s error is not finite");
        }
        const double largest = std::max(state_.*scale, field.size);
        if (const double error = largest > 0 ? field.error / largest : 0.0; error > attempt.error) {
            attempt.error = error;
            attempt.of = name;
        }
    }
    return attempt;
}

void Simulation::count_attempts(const StepCounts& counts) {
    for (const Attempt& attempt : counts.attempts) {
        const bool taken = is_taken(attempt);
        totals_.accepted += taken ? 1 : 0;
        totals_.error_sum += taken ? attempt.error : 0.0;
        totals_.rejected += attempt.outcome == Attempt::Outcome::rejected ? 1 : 0;
        totals_.beyond_tolerance += attempt.outcome == Attempt::Outcome::beyond_tolerance ? 1 : 0;
    }
}

}  // namespace thermocontact::march

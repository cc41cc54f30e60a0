/// One step of any time scheme, as a formula for a field y and its rate.
///
/// The balances hold at a stage, t_s = t + alpha k of the step from t to t + k, for the value y_s and the
/// rate r_s there:
///
///   y_s = y + alpha (y_new - y),      y_s = y_hat + tau r_s,      y_hat = y + (alpha k - tau) q.
///
/// To a balance this is backward Euler from y_hat over tau, whatever the scheme. Rates are taken linear in
/// time: q, which the step begins with, holds at t - lag, the mean rate d = (y_new - y)/k at t + k/2, and r_s
/// at t_s. Hence tau = alpha k (k/2 + lag)/(alpha k + lag), and the next q, at t + k - (alpha - 1/2) k,
/// follows.
///
///   backward-euler      alpha = 1, tau = k; q has no weight                                       order 1
///   generalized-alpha   alpha = 1/(1 + rho), lag = (alpha - 1/2) k of the last step (Jansen, Whiting and
///                       Hulbert 2000; rho is the spectral radius at infinite frequency)           order 2
///   midpoint            the same with rho = 1: tau = k/2, and q has no weight
///   bdf2                the same with rho = 0: the two-step formula on variable steps
///
/// Where there is no q yet, the step is one of backward Euler, whatever the scheme; its local error is of the
/// order of the global one.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::march {

struct StepRule {
    double begin, end;  ///< t and t + k, s
    double step;        ///< k, s
    double alpha;
    double tau;       ///< s
    double lag;       ///< s; negative: there is no q
    double steering;  ///< of d - q in what the step adds to q
    int order;

    double stage_time() const { return ends_at_stage() ? end : begin + alpha * step; }
    bool ends_at_stage() const { return alpha == 1; }
    double memory() const { return alpha * step - tau; }  ///< weight of q in y_hat, s
    bool has_rate() const { return lag >= 0; }            ///< q
    /// Weight of q in what is expected of the stage before it is solved, s: nothing new in backward Euler.
    double outlook() const { return order == 1 ? 0.0 : alpha * step; }

    /// The value at the end of the step from those at its begin and at the stage, and the other way round: to
    /// the last bit the same where the stage is the end.
    double completed(double y, double stage) const {
        return ends_at_stage() ? stage : y + (stage - y) / alpha;
    }
    double staged(double y, double y_new) const { return ends_at_stage() ? y_new : y + alpha * (y_new - y); }
};

class Scheme {
  public:
    explicit Scheme(const scene::TimeSpec& time);

    bool second_order() const { return second_order_; }
    /// Whether steps begin with rates: they enter the formula, or the estimate of the error.
    bool carries_rates() const { return second_order_ || estimates_; }
    /// Whether they begin with the curvature, too (step_error.h).
    bool carries_curvature() const { return second_order_ && estimates_; }

    /// The step of size `step` (s) from `begin` to `end`; `last_step`: size of the step before, 0 where there
    /// are no rates.
    StepRule rule(double begin, double end, double step, double last_step) const;

  private:
    double alpha_;
    bool second_order_, estimates_;
};

/// y + seconds * q, or y itself where there is no q, from place `begin` on, before `end`.
void extrapolate(double seconds, const std::vector<double>& y, const std::vector<double>& q,
                 std::ptrdiff_t begin, std::ptrdiff_t end, std::vector<double>& result);

/// The rate q for the step after the one from y to y_new.
void renew_rate(const StepRule& rule, const std::vector<double>& y, const std::vector<double>& y_new,
                std::vector<double>& q);

}  // namespace thermocontact::march

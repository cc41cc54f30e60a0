/// What one step adds to the error of a field, as the rates tell that it begins and ends with (step_rule.h):
///
///   order 1:  k^2/2 |y''|      backward Euler
///   order 2:  C k^3 |y'''|     C = alpha/(2 alpha - 1/2) (3/2 (alpha - 1/2)^2 + alpha (1 - alpha)/2 - 1/24)
///
/// These are the principal terms of the local error (Hairer, Norsett and Wanner, Solving Ordinary
/// Differential Equations I, II.2 and III.2). C follows when y' = f(y) is solved on equal steps: rates linear
/// in time miss y' at the stage by (1/24 - 3/2 (alpha - 1/2)^2) k^2 y''', values linear in time miss y there
/// by alpha (1 - alpha)/2 k^2 y'', and d errs by alpha/(2 alpha - 1/2) of what the rate at the stage does.
/// C = 2/9 for bdf2, 4/45 for rho = 1/2; on steps that change by a factor of 2 it is off by less than 2.
///
/// y'' = (d - q)/(k/2 + lag) holds in the middle between the times of these two rates, y''' follows from this
/// y'' and the last one. A scheme of second order has no y''' before its third step and is judged by the
/// formula of order 1 until then; the first step of all has nothing to be judged by.
#pragma once

#include <vector>

#include "march/step_rule.h"

namespace thermocontact::march {

/// Norms, over all processes: of what a step adds to the error of a field, and of the field after the step.
struct FieldError {
    double error = 0, size = 0;
};

/// C.
double error_constant(double alpha);

/// The formula that applies: `curvature_lag` is how long before the step the last y'' held (s); 0: there is
/// none.
int estimate_order(const StepRule& rule, double curvature_lag);

/// The formula at every node, of the sign of the derivative; `q`, `curvature`: what the step begins with.
/// Empty where there is nothing to judge by.
std::vector<double> error_estimate(const StepRule& rule, double curvature_lag, const std::vector<double>& y,
                                   const std::vector<double>& y_new, const std::vector<double>& q,
                                   const std::vector<double>& curvature);

/// Rate and y'' at the end of the step, as far as the scheme carries them.
void renew_rates(const Scheme& scheme, const StepRule& rule, const std::vector<double>& y,
                 const std::vector<double>& y_new, std::vector<double>& q, std::vector<double>& curvature);

/// How long before the end of the step that y'' holds, s; 0 where there is none.
double curvature_lag(const Scheme& scheme, const StepRule& rule);

}  // namespace thermocontact::march

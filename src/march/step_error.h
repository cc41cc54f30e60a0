/// What a step adds to the error of a field, as the rates tell that it begins and ends with (step_rule.h):
///
///   order 1:  k^2/2 |y''|, backward Euler's local error
///   order 2:  2/9 k^3 |y'''|, that of bdf2 on equal steps, the largest of the schemes
///
/// with y'' = (d - q)/(k/2 + lag), in the middle between these rates, and y''' from this y'' and the last
/// one. A scheme of second order has no y''' before its third step, and is judged as one of first order until
/// then; the first step of all has nothing to be judged by, and is taken short.
#pragma once

#include <algorithm>
#include <vector>

#include "march/step_rule.h"
#include "parallel/team.h"

namespace thermocontact::march {

/// The largest at a node.
struct StepError {
    double error = 0, size = 0;  ///< of the field's own unit; size: of the field itself

    /// Over all processes.
    double relative(const parallel::Team& team) const {
        double largest[2] = {error, size};
        team.max(largest);
        return largest[1] > 0 ? largest[0] / largest[1] : 0.0;
    }
};

/// One field over a step. `curvature_lag`: how long before the step the last y'' held (s); 0: there is none.
StepError step_error(const StepRule& rule, double curvature_lag, const std::vector<double>& y,
                     const std::vector<double>& y_new, const std::vector<double>& q,
                     const std::vector<double>& curvature);

/// Rate and y'' at the end of the step, as far as the scheme carries them.
void renew_rates(const Scheme& scheme, const StepRule& rule, const std::vector<double>& y,
                 const std::vector<double>& y_new, std::vector<double>& q, std::vector<double>& curvature);

/// How long before the end of the step that y'' holds, s.
double curvature_lag(const StepRule& rule);

/// Which errors are small enough, and when longer steps are worth a try.
struct ErrorControl {
    double tolerance;  ///< relative, of one step

    static constexpr double safety = 0.7;

    bool accepts(double error) const { return error <= tolerance; }
    bool lengthens(double error, int order) const {
        return error * (order == 1 ? 4.0 : 8.0) <= safety * tolerance;
    }
};

}  // namespace thermocontact::march

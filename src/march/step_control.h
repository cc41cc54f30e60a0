/// The size of adaptive steps.
///
/// Sizes are rungs of a ladder: the scene's step halved 0 to 8 times, each step begun at a multiple of its
/// own size (subdivision.h). The measure of a step is the largest of its errors (step_error.h), each relative
/// to the largest size so far:
///
///   displacement, velocity, temperature   their norms in L2
///   deformation                           the root of the elastic energy, relative to that of elastic and
///                                         kinetic energy together: a body in flight has no strain to speak
///                                         of
///
///   rejected   error > tolerance: down by as many rungs as bring the predicted error to safety * tolerance
///              or below, one at least. On the lowest rung the step is taken all the same, and counted.
///   longer     after `patience` steps of one size: up by as many rungs as keep the predicted error at or
///              below safety * tolerance and as the place in the scene's step allows.
///
/// The first step has nothing to be judged by, and the fields may grow from zero: the scene's step is tried
/// whole for the norms to which errors are relative, not taken, and begun again on the lowest rung.
///
/// Predicted: a size halved r times errs 2^(-r (order + 1)) of it. A new size costs a factorisation, which is
/// worth some ten to twenty steps of condensed contact: `patience` lets each be of use, and lets a climb skip
/// rungs. A step that was not solved (recovery) is halved, too, and the next climb waits four times as long.
#pragma once

#include <algorithm>
#include <cmath>

namespace thermocontact::march {

struct StepControl {
    double tolerance;  ///< relative, of one step

    static constexpr double safety = 0.7;
    static constexpr int patience = 8;
    static constexpr int after_failure = -3 * patience;  ///< what steps at this size are counted from

    bool accepts(double error) const { return error <= tolerance; }

    /// Rungs down for a step that was rejected.
    int down(double error, int order) const {
        return std::max(1, static_cast<int>(std::ceil(rungs(error, order))));
    }

    /// Rungs up after a step of a size that was taken so many times.
    int up(double error, int order, int steps_at_this_size) const {
        if (steps_at_this_size < patience) {
            return 0;
        }
        return error > 0 ? std::max(0, static_cast<int>(std::floor(-rungs(error, order)))) : most_rungs;
    }

  private:
    static constexpr int most_rungs = 64;

    /// How many halvings bring the error to safety * tolerance.
    double rungs(double error, int order) const {
        const double exact = std::log2(error / (safety * tolerance)) / (order + 1);
        return std::clamp(exact, -1.0 * most_rungs, 1.0 * most_rungs);
    }
};

}  // namespace thermocontact::march

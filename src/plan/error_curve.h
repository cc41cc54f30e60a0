/// The error of one source, space or time, as a function of the knob that it falls with.
///
/// A ladder of runs is refined in one direction alone: the knob x (mesh size, step, tolerance) goes from x_0
/// down to x_L. With d_i the difference of the runs i and i + 1, the observed order p is the slope of log d_i
/// over log x_i from the first to the last of those looked at, taken no higher than theory has it and no
/// lower than `lowest_order`: where contact ends errors fall as stairs do, and a slope of two steps tells
/// little. The errors E and e of two runs and their difference d are sides of a triangle,
///
///     E^2 = e^2 + d^2 + 2 c e d,
///
/// where c is 1 if refinement takes off the same error again and again, as of smooth solutions, and 0 if each
/// time another part of it, as of projections on nested spaces. Three runs show which: c is that of their
/// three differences, the larger of two such where there are four runs (one number goes up and down: |c|).
/// With E = (x_{L-1}/x_L)^p e the error left in the finest run follows from d: d_{L-1}, or, where d_{L-2}
/// leads one to expect more, the geometric mean of both: contact opens and closes point by point, and a
/// difference may be small by chance. The error of the run i follows from its difference to the finest.
/// Beyond the finest, errors fall as x^p. Where another run is more to be trusted than the finest, errors are
/// of the differences to that and what is left in it.
#pragma once

#include <string>
#include <vector>

#include "plan/log_curve.h"

namespace thermocontact::plan {

/// With less, differences do not fall visibly: nothing can be said of what is left.
inline constexpr double lowest_order = 0.1;

inline constexpr std::size_t slopes_looked_at = 3;

/// E above, of a run that differs by `difference` from one of error `finer`.
double error_beside(double finer, double difference, double cosine);

/// d above.
double difference_between(double coarser, double finer, double cosine);

struct Ladder {
    std::vector<double> knobs;                         ///< [levels], falling
    std::vector<std::vector<double>> steps;            ///< [levels - 1][components]: d_i
    std::vector<std::vector<double>> from_the_finest;  ///< [levels - 1][components]
    std::vector<double> sizes;                         ///< [components]: what errors are relative to
    /// Of another run than the finest: [levels][components] differences, and [components] its own error.
    std::vector<std::vector<double>> from_reference = {};
    std::vector<double> left_in_reference = {};
};

class ErrorCurve {
  public:
    /// No error at all, of so many components: for what is not refined.
    explicit ErrorCurve(std::size_t components = 0);

    /// `highest_orders` [components]: those of theory. At least two levels; with two the order is taken to be
    /// half of theory's.
    /// `lowest_orders` [components]: that the order is not to be below; empty: `lowest_order`.
    ErrorCurve(const Ladder& ladder, const std::vector<double>& highest_orders,
               const std::vector<double>& lowest_orders = {});

    /// [components], relative; errors coarser than the coarsest run's are extrapolated and worth little.
    std::vector<double> at(double knob) const;

    /// [components], relative: what runs at two knobs differ by.
    std::vector<double> between(double coarser, double finer) const;

    /// The largest of at().
    double largest_at(double knob) const;

    /// [components]: observed, as taken.
    const std::vector<double>& orders() const { return orders_; }

    double coarsest() const { return coarsest_; }  ///< knob; 0: no error
    double finest() const { return finest_; }      ///< knob

    /// Multiplies the errors [components]: what a run elsewhere has shown.
    void correct(const std::vector<double>& factors);

  private:
    std::vector<LogCurve> curves_;
    std::vector<double> orders_, cosines_, factors_;
    double coarsest_ = 0, finest_ = 0;
};

}  // namespace thermocontact::plan

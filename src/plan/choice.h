/// The cheapest discretisation of those that the models cover.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plan/discretisation.h"
#include "plan/error_curve.h"
#include "plan/writing.h"

namespace thermocontact::plan {

/// How the errors of two sources add up: in the norms of fields, where they have little to do with each
/// other, as the root of the sum of their squares; in a single number wholly.
enum class Sum { squares, plain };

double combined(double space, double time, Sum sum);

/// The largest of both sources' combined errors.
double total_error(const std::vector<double>& space, const std::vector<double>& time, Sum sum);

/// What meshes of one kind (kind_of_mesh()) err by and cost, by their scale; the knob of the error is
/// 1/scale.
struct SpaceModel {
    int degree;
    std::vector<scene::Grading> grading;  ///< see Discretisation
    ErrorCurve error;
    LogCurve setup, factor, step;  ///< s: once, a factorisation of both balances, a step
    LogCurve unknowns;
    LogCurve frame;   ///< s to put the fields into the form of their files once
    LogCurve end;     ///< s: digits left, judged once at the end
    double near = 0;  ///< knob of the finest pilot of a ladder around a choice (near_choice.h); 0: of none
    std::vector<int> stretch = {};              ///< see Discretisation
    LogCurve factor_bytes = {{1.0}, {0.0}, 0};  ///< of one factor of each balance; 0: no factors
};

/// What a way to step errs by, and how many steps it takes; the knob is 1/steps, or the tolerance.
struct TimeModel {
    Stepping stepping;
    ErrorCurve error;
    LogCurve attempts;
    std::vector<LogCurve> factorisations;  ///< where 1, 2, ... factors of each balance are kept
    LogCurve damped;                       ///< see Pilot::damped
    double near = 0;                       ///< see SpaceModel
};

/// s, measured: a row of the history. To put fields into the form of their files and write them takes so many
/// times what the first of that takes; what the files take besides is measured where they go (writing.h).
inline constexpr double seconds_of_row = 3.5e-5;
inline constexpr double writing_per_forming = 1.2;

struct Models {
    std::vector<SpaceModel> spaces;
    std::vector<TimeModel> times;
    bool refinable = true;  ///< the mesh, which is no file's
    int frames = 0;         ///< how often the scene writes its fields; 0: never
    Sum sum = Sum::squares;
    Writing writing = {};
    double memory = std::numeric_limits<double>::infinity();  ///< bytes, for a run's factors
};

/// A discretisation with what the models say of it.
struct Option {
    Discretisation discretisation;
    std::vector<double> space, time;  ///< [components]: relative errors
    double error;                     ///< the largest of both combined
    double seconds, unknowns;
};

struct Limits {
    double seconds, unknowns;
};

/// The model of its mesh, and of its stepping.
const SpaceModel& space_of(const Models& models, const Discretisation& choice);
const TimeModel& time_of(const Models& models, const Discretisation& choice);
SpaceModel& space_of(Models& models, const Discretisation& choice);
TimeModel& time_of(Models& models, const Discretisation& choice);

/// [components], relative: what the models say that two runs on meshes of one kind, stepped in one way,
/// differ by.
std::vector<double> difference(const Models& models, const Discretisation& coarse,
                               const Discretisation& fine);

/// Factorisations of both balances: step sizes come again, and the factors of only so many are kept as
/// memory holds beside one that is made (march/kept_factors.h).
double factorisations(const Models& models, const SpaceModel& space, const TimeModel& time,
                      const Discretisation& choice);

/// What the models say of one discretisation.
Option assess(const Models& models, const Discretisation& discretisation);

/// s that it takes without its output.
double seconds_without_output(Models models, const Discretisation& discretisation);

/// The discretisation of the smallest predicted time among those with an error of at most `aim`, within the
/// limits.
std::optional<Option> cheapest(const Models& models, double aim, const Limits& limits);

/// That of the smallest error within the limits.
std::optional<Option> most_accurate(const Models& models, const Limits& limits);

/// The knob of a discretisation's time.
double time_knob(const Discretisation& discretisation);

}  // namespace thermocontact::plan

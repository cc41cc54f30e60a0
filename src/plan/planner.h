/// From a request to a discretisation: short pilots, models of error and time, a choice and its neighbours.
///
/// The error is that of the discretisation: of mesh, degree, step and scheme. The friction's regularisation
/// and the contact's quadrature are the scene's, part of the problem that is posed. What space and time err
/// by is found apart, each by refining that one alone (error_curve.h), and combined (choice.h); pilots near
/// the choice then correct both, as an error of space may depend on the step and the reverse.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/bench.h"
#include "plan/choice.h"
#include "plan/climb.h"
#include "plan/difference.h"
#include "plan/request.h"

namespace thermocontact::plan {

struct Plan {
    Request request;
    std::vector<std::string> components;
    Models models;
    std::optional<Option> chosen;           ///< nothing: the request cannot be met
    std::optional<Option> cheaper, better;  ///< the next offers
    std::optional<Option> best;             ///< where nothing is chosen: the most accurate that is affordable
    std::string refusal;                    ///< why nothing is chosen
    std::vector<std::string> remarks;
    int pilots = 0;
    double pilot_seconds = 0;
    std::vector<std::string> settings;  ///< of what is chosen, or else of the best
};

/// Share of the accuracy asked for that is aimed at.
inline constexpr double aim_of_accuracy = 0.65;

class Planner {
  public:
    /// What the pilots take is part of the budget if `budget_counts_pilots`. All must outlive this. Throws
    /// SceneError where the scene has not got the quantity.
    Planner(Bench& bench, Request request, bool budget_counts_pilots);

    /// Throws NumericsError where no pilot could be run.
    Plan make();

  private:
    Climb climb_of(const Stepping& stepping, double allowance) const;
    void climb_in_time();
    void climb_in_space();
    void add_space(int degree, const Stepping& stepping, int steps, double tolerance);
    void approach();
    bool correct_near(const Option& option);
    std::optional<Option> choose(double accuracy_factor) const;
    void refuse();
    double pilot_allowance() const;
    double goal() const;
    Limits limits() const;
    std::vector<double> highest_orders_in_space(int degree) const;

    Bench* bench_;
    Comparison comparison_;
    bool counts_pilots_;
    Plan plan_;
};

}  // namespace thermocontact::plan

/// From a request to a discretisation: short pilots, models of error and time, a choice and its neighbours.
///
/// The error is that of the discretisation: of mesh, degree, step and scheme. The friction's regularisation
/// and the contact's quadrature are the scene's, part of the problem that is posed. What space and time err
/// by is found apart (time_study.h, space_study.h), each by refining that one alone (error_curve.h), and
/// combined (choice.h); ladders near the choice then take the place of those far from it (near_choice.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plan/study.h"

namespace thermocontact::plan {

inline constexpr double longest_run = 3600;  ///< s, of a run that is planned without a budget

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

class Planner {
  public:
    /// What the pilots take is part of the budget if `budget_counts_pilots`. `bench` must outlive this.
    /// Throws SceneError where the scene has not got the quantity.
    Planner(Bench& bench, const Request& request, bool budget_counts_pilots);

    /// Throws NumericsError where no pilot could be run.
    Plan make();

  private:
    void study(Plan& plan);
    void approach();
    std::optional<Option> choose(const Models& models, double accuracy_factor) const;
    std::optional<Option> nearly() const;
    double seconds_near(const Option& option) const;
    void choose_all(Plan& plan) const;
    void refuse(Plan& plan) const;
    Limits limits() const;

    Study study_;
    bool counts_pilots_;
};

}  // namespace thermocontact::plan

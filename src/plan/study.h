/// What the parts of planning share: the request, the pilots, and the models made from them.
#pragma once

#include <string>
#include <vector>

#include "plan/bench.h"
#include "plan/choice.h"
#include "plan/difference.h"
#include "plan/request.h"

namespace thermocontact::plan {

/// s that meshes of other shapes may be looked for near choices, in all (near_choice.h).
inline constexpr double longest_for_shapes = 120;

struct Study {
    Bench* bench;
    Comparison comparison;
    Request request;
    Models models;
    std::vector<std::string> remarks;
    double goal = 0;  ///< what either source may leave in its finest pilot: less than that need not be known
    double seconds_for_shapes = longest_for_shapes;  ///< that are left of it
};

/// Share of the accuracy asked for that is aimed at: in the middle, on a logarithmic scale, of a third of it
/// and all of it.
inline constexpr double aim_of_accuracy = 0.6;

/// The same where that would take too long.
inline constexpr double least_aim = 0.85;

/// Of a scene whose quantity is asked for; without times and spaces. `goal` of the accuracy may be left in
/// the finest pilots. `bench` must outlive it. Throws SceneError where the scene has not got the quantity.
Study begin_study(Bench& bench, const Request& request, double goal);

/// s of processor time that one pilot of a ladder may take.
double pilot_allowance(const Request& request);

/// s that are left of the share of a budget that planning may take; infinite without one.
double seconds_for_pilots(const Study& study);

/// s that what was asked takes on meshes of these kinds alone, or, in a budget, the error that is left;
/// infinite where they cannot meet it. Neither time nor memory is limited otherwise.
double price_of(const Study& study, std::vector<SpaceModel> spaces);

/// The most unknowns that a run may have, for the memory there is.
double most_unknowns();

}  // namespace thermocontact::plan

/// What the parts of planning share: the request, the pilots, and the models made from them.
#pragma once

#include <string>
#include <vector>

#include "plan/bench.h"
#include "plan/choice.h"
#include "plan/difference.h"
#include "plan/request.h"

namespace thermocontact::plan {

struct Study {
    Bench* bench;
    Comparison comparison;
    Request request;
    Models models;
    std::vector<std::string> remarks;
};

/// Share of the accuracy asked for that is aimed at: in the middle, on a logarithmic scale, of a third of it
/// and all of it.
inline constexpr double aim_of_accuracy = 0.6;

/// Of a scene whose quantity is asked for; without times and spaces. `bench` must outlive it. Throws
/// SceneError where the scene has not got the quantity.
Study begin_study(Bench& bench, const Request& request);

/// s of processor time that one pilot of a ladder may take.
double pilot_allowance(const Request& request);

/// What either source may leave in its finest pilot: less than that need not be known.
double goal(const Request& request);

/// The most unknowns that the memory holds.
double most_unknowns();

}  // namespace thermocontact::plan

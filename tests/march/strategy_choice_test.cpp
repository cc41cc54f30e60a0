#include "march/strategy_choice.h"

#include <gtest/gtest.h>

#include <limits>

#include "error.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

StrategyChoice choose(const support::Discretisation& problem, double memory) {
    const parallel::Part part{problem.mesh, problem.space, {}, {}, 0, 0};
    return choose_strategy(problem.scene, problem.graph, part, problem.surfaces, nullptr, memory);
}

support::Discretisation box(const std::string& strategy, int cells) {
    const std::string n = std::to_string(cells);
    return support::Discretisation(support::repository_scene(
        "box", {"mesh.cells=[" + n + "," + n + "," + n + "]", "solver.strategy=\"" + strategy + "\""}));
}

TEST(StrategyChoice, SmallScenesAreCondensed) {
    const StrategyChoice choice =
        choose(support::Discretisation(support::repository_scene("paper")), unlimited);
    EXPECT_EQ(choice.strategy->name(), "condensed");
    EXPECT_NE(choice.why.find("foreseen: condensed"), std::string::npos) << choice.why;
}

TEST(StrategyChoice, WhatDoesNotFitInMemoryIsNotCondensed) {
    EXPECT_THROW(choose(box("auto", 4), 1e4), parallel::BackendNeeded);
    EXPECT_THROW(choose(box("condensed", 4), 1e4), SystemError);
    EXPECT_EQ(choose(box("condensed", 4), unlimited).why.substr(0, 9), "asked for");
}

// The Newton-Krylov forecast grows as the number of unknowns, that of condensing at least as its square in
// 3D, as the last separator is dense: at some size the first is the lower one.
TEST(StrategyChoice, LargeBodiesInSpaceAreNotCondensed) {
    EXPECT_THROW(choose(box("auto", 26), unlimited), parallel::BackendNeeded);
}

TEST(StrategyChoice, NewtonKrylovNeedsABackend) {
    EXPECT_THROW(choose(box("newton-krylov", 2), unlimited), parallel::BackendNeeded);
}

}  // namespace
}  // namespace thermocontact::march

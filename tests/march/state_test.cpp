#include "march/state.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace thermocontact::march {
namespace {

TEST(State, EveryMemberIsVisitedOnceAndCanBeSet) {
    State state{3,
                0.25,
                {1, 2},
                {3, 4},
                {5},
                {20, 21},
                0.1,
                {6, 7},
                {8, 9},
                {10},
                0.2,
                4,
                {Nodal{22}, Nodal{26}, Nodal{27}},
                {Nodal{23}, Nodal{28}, Nodal{29}},
                2,
                5,
                0.3,
                {11, 12},
                {13, 14},
                {15},
                16,
                17,
                18,
                19,
                24,
                25};
    std::vector<std::string> names;
    visit_members(std::as_const(state), [&](const std::string& name, const auto&) { names.push_back(name); });
    EXPECT_EQ(names, (std::vector<std::string>{"step",
                                               "time",
                                               "displacement",
                                               "velocity",
                                               "temperature",
                                               "friction_multiplier",
                                               "last_step",
                                               "displacement_rate",
                                               "velocity_rate",
                                               "temperature_rate",
                                               "even_step",
                                               "even_steps",
                                               "velocity_1_before",
                                               "temperature_1_before",
                                               "velocity_2_before",
                                               "temperature_2_before",
                                               "velocity_3_before",
                                               "temperature_3_before",
                                               "halvings",
                                               "since_change",
                                               "curvature_lag",
                                               "displacement_curvature",
                                               "velocity_curvature",
                                               "temperature_curvature",
                                               "displacement_scale",
                                               "deformation_scale",
                                               "velocity_scale",
                                               "temperature_scale",
                                               "deformation_energy",
                                               "heat_energy"}));
    visit_members(state, [](const std::string&, auto& member) { member = {}; });
    EXPECT_EQ(state.step, 0);
    EXPECT_EQ(state.time, 0);
    EXPECT_EQ(state.last_step, 0);
    EXPECT_TRUE(state.displacement.empty() && state.velocity.empty() && state.temperature.empty());
    EXPECT_TRUE(state.friction_multiplier.empty());
    EXPECT_TRUE(state.displacement_rate.empty() && state.velocity_rate.empty() &&
                state.temperature_rate.empty());
    EXPECT_EQ(state.past_velocity, PastValues());
    EXPECT_EQ(state.past_temperature, PastValues());
    EXPECT_EQ(state.halvings, 0);
    EXPECT_EQ(state.since_change, 0);
    EXPECT_EQ(state.curvature_lag, 0);
    EXPECT_TRUE(state.displacement_curvature.empty() && state.velocity_curvature.empty() &&
                state.temperature_curvature.empty());
    EXPECT_EQ(
        state.displacement_scale + state.deformation_scale + state.velocity_scale + state.temperature_scale,
        0);
}

}  // namespace
}  // namespace thermocontact::march

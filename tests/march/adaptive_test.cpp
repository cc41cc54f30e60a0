// Steps that adapt to time.tolerance: where they are short, what a rejection leaves behind, what error is
// reached.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

using Outcome = Attempt::Outcome;

/// A slab that a sudden heat flux and then a sudden load meet.
std::string sudden(const std::string& tolerance, const std::string& scheme) {
    return "mesh = {cells = [2, 6]}\ntime = {end = 2, steps = 4, scheme = \"" + scheme + "\"" +
           (tolerance.empty() ? "" : ", tolerance = " + tolerance) +
           "}\n"
           "material = {density = 1, elasticity = {young = 5, poisson = 0.2}, viscosity = {trace = 1, shear "
           "= 1}}\n"
           "heat = {capacity = 1, conductivity = 1, thermal_stress = 0.2, strain_heating = 0.2}\n"
           "load.body_force = [\"0.1*sin(3*t)\", 0]\n"
           "boundary.top = {displacement = [0, 0], temperature = 0}\n"
           "boundary.bottom = {heat_flux = 1, traction = [0, \"t > 1 ? 1 : 0\"]}\n";
}

/// A block that meets the foundation at about t = 0.4 and lifts off again.
support::Overrides thrown(const support::Overrides& more) {
    support::Overrides all{"mesh.cells=[6,6]", "time.end=1", "time.steps=4", "load.body_force=[0,-1.5]",
                           "boundary.bottom.contact.gap=0.05"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

struct Course {
    State state;
    Totals totals;
    std::vector<Attempt> attempts;
    double substeps = 0;  ///< of the history
};

double value(const Record& row, const std::string& name) {
    return std::ranges::find(row, name, &Record::value_type::first)->second;
}

Course march(const scene::Scene& scene) {
    Simulation simulation(scene);
    Course course;
    while (!simulation.finished()) {
        simulation.advance();
        EXPECT_EQ(simulation.state().time, scene.time.end * simulation.state().step / scene.time.steps);
        course.substeps += value(simulation.record(), "substeps");
        course.attempts.insert(course.attempts.end(), simulation.attempts().begin(),
                               simulation.attempts().end());
    }
    course.state = simulation.state();
    course.totals = simulation.totals();
    return course;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return largest / size;
}

class Adaptive : public testing::TestWithParam<std::string> {};

TEST_P(Adaptive, StepsAreShortAfterSuddenLoadsAndLongElsewhere) {
    const Course course = march(scene::read(sudden("1e-2", GetParam())));
    double reached = 0, before_jump = 0, after_jump = 1, size = 1;
    int of_this_size = 0;
    for (const Attempt& attempt : course.attempts) {
        if (attempt.size > size) {
            EXPECT_GE(of_this_size, StepControl::patience) << "before it is lengthened";
        }
        of_this_size = !is_taken(attempt) ? 0 : attempt.size == size ? of_this_size + 1 : 1;
        size = attempt.size;
        EXPECT_NEAR(attempt.end - attempt.size, reached, 1e-14) << "each begins where the last one ended";
        reached = is_taken(attempt) ? attempt.end : reached;
        if (is_taken(attempt) && attempt.end <= 1) {
            before_jump = attempt.size;
        } else if (is_taken(attempt) && attempt.end <= 1.1) {
            after_jump = std::min(after_jump, attempt.size);
        }
        EXPECT_EQ(attempt.error > 1e-2,
                  attempt.outcome == Outcome::rejected || attempt.outcome == Outcome::beyond_tolerance);
    }
    EXPECT_EQ(reached, 2.0);
    EXPECT_EQ(course.attempts.front().outcome, Outcome::trial);
    EXPECT_EQ(course.attempts.front().size, 0.5);
    EXPECT_EQ(course.attempts.at(1).size, 0.5 / 256);
    EXPECT_GE(before_jump, 8 * after_jump);
    EXPECT_GT(course.totals.rejected, 0) << "nothing was rejected: the case tests little";
    EXPECT_EQ(course.totals.accepted, std::ranges::count_if(course.attempts, is_taken));
    EXPECT_EQ(course.totals.accepted, course.substeps);
    EXPECT_EQ(course.totals.accepted + course.totals.rejected + 1, std::ssize(course.attempts));
    // rejected steps leave no trace in the balances
    EXPECT_LE(course.totals.energy_residual, 1e-11);
    EXPECT_LE(course.totals.force_residual, 1e-11);
    EXPECT_LE(course.totals.heat_residual, 1e-11);
}

/// The error follows the tolerance, and takes fewer steps than equal ones as short as the shortest.
TEST_P(Adaptive, ErrorFollowsTheTolerance) {
    const Course exact = march(scene::read(sudden("1e-6", GetParam()))),
                 coarse = march(scene::read(sudden("1e-2", GetParam()))),
                 fine = march(scene::read(sudden("1e-4", GetParam())));
    // a hundredth of the tolerance: a tenth of the error in order 1, a twentieth in order 2, as steps go
    // with its root; a half leaves room for the rungs
    for (Nodal State::*field : {&State::velocity, &State::temperature}) {
        EXPECT_LT(difference(fine.state.*field, exact.state.*field),
                  difference(coarse.state.*field, exact.state.*field) / 2);
    }
    EXPECT_LT(coarse.totals.accepted, fine.totals.accepted);
    EXPECT_LT(coarse.totals.accepted, 2.0 / coarse.totals.smallest_step / 4);
}

/// Steps are shortest where the block is caught.
TEST_P(Adaptive, StepsAreShortInAnImpact) {
    const scene::Scene scene = support::repository_scene(
        "isothermal", thrown({"time.tolerance=2e-3", "time.scheme=\"" + GetParam() + "\""}));
    Simulation simulation(scene);
    std::vector<double> shortest, closed;
    while (!simulation.finished()) {
        simulation.advance();
        double smallest = 1;
        for (const Attempt& attempt : simulation.attempts()) {
            smallest = is_taken(attempt) ? std::min(smallest, attempt.size) : smallest;
        }
        const Record row = simulation.record();
        shortest.push_back(smallest);
        closed.push_back(value(row, "contact_fraction"));
    }
    ASSERT_EQ(closed.size(), 4U);
    const auto met = std::ranges::find_if(closed, [](double fraction) { return fraction > 0; });
    ASSERT_NE(met, closed.end()) << "no contact: the case tests nothing";
    ASSERT_GT(met - closed.begin(), 1) << "flight first, after the sudden start";
    const auto impact = static_cast<std::size_t>(met - closed.begin());
    EXPECT_GE(shortest[impact - 1], 4 * shortest[impact]);
}

/// The course of a step that begins with rejections, and that of a simulation which begins it with the size
/// that was accepted at last; nothing where the first attempt was accepted.
struct Pair {
    std::vector<Attempt> rejecting, direct;
    State after_rejections, after_none;
    int rejected = 0;  ///< before the first that was accepted
};

std::optional<Pair> with_and_without_rejection(const scene::Scene& scene, int step) {
    Simulation rejecting(scene);
    while (rejecting.state().step < step) {
        rejecting.advance();
    }
    Snapshot start = rejecting.snapshot();
    rejecting.advance();
    Pair pair{rejecting.attempts(), {}, rejecting.state(), {}};
    const auto first = std::ranges::find_if(pair.rejecting, is_taken);
    pair.rejected = static_cast<int>(first - pair.rejecting.begin());
    if (pair.rejected == 0) {
        return std::nullopt;
    }
    const double whole = scene.time.end / scene.time.steps;
    start.state.halvings = static_cast<int>(std::lround(std::log2(whole / first->size)));
    start.state.since_change = 0;
    Simulation direct(scene);
    direct.resume(start);
    direct.advance();
    pair.direct = direct.attempts();
    pair.after_none = direct.state();
    return pair;
}

void expect_same_course(const Pair& pair) {
    ASSERT_EQ(pair.direct.size() + static_cast<std::size_t>(pair.rejected), pair.rejecting.size());
    for (std::size_t i = 0; i < pair.direct.size(); ++i) {
        const Attempt& attempt = pair.rejecting[i + static_cast<std::size_t>(pair.rejected)];
        EXPECT_EQ(pair.direct[i].size, attempt.size);
        EXPECT_EQ(pair.direct[i].end, attempt.end);
        EXPECT_EQ(pair.direct[i].outcome, attempt.outcome);
    }
}

void expect_same_bits(const State& a, const State& b) {
    visit_members(a, [&](const std::string& name, const auto& member) {
        visit_members(b, [&](const std::string& other, const auto& its) {
            if constexpr (std::is_same_v<decltype(member), decltype(its)>) {
                // the sizes of fields are sums over nodes, which depend on where the numbers lie in memory
                EXPECT_TRUE(name != other || name.ends_with("_scale") || member == its) << name;
            }
        });
    });
}

/// What was rejected leaves no trace.
TEST_P(Adaptive, ARejectionChangesNoBit) {
    const auto pair = with_and_without_rejection(scene::read(sudden("1e-3", GetParam())), 2);
    ASSERT_TRUE(pair) << "nothing was rejected: the case tests nothing";
    expect_same_course(*pair);
    expect_same_bits(pair->after_rejections, pair->after_none);
}

support::Overrides pushed(const std::string& scheme, const std::string& load) {
    return {"mesh.cells=[4,4]",
            "time.end=8",
            "time.steps=8",
            "time.tolerance=1e-3",
            "time.scheme=\"" + scheme + "\"",
            "boundary.left.traction=[\"t > 5 ? " + load + " : 1.4\", 0.4]"};
}

/// With contact Newton's method goes on with the derivatives that it has kept of a step size, those of steps
/// that were rejected, too: the last digits that solver.tolerance leaves open may differ.
TEST_P(Adaptive, ARejectionChangesNothingInContact) {
    int cases = 0;
    for (const char* load : {"1.42", "1.5", "2", "4"}) {
        const auto pair =
            with_and_without_rejection(support::repository_scene("paper", pushed(GetParam(), load)), 5);
        if (pair) {
            ++cases;
            expect_same_course(*pair);
            for (Nodal State::*field : {&State::displacement, &State::velocity, &State::temperature}) {
                EXPECT_LE(difference(pair->after_rejections.*field, pair->after_none.*field), 1e-9) << load;
            }
        }
    }
    EXPECT_GT(cases, 0) << "nothing was rejected: the case tests nothing";
}

/// No derivative is met again where a single rejection halves the whole step.
TEST(AdaptiveContact, ARejectionChangesNoBit) {
    int cases = 0;
    for (const char* load : {"1.41", "1.415", "1.42", "1.43", "1.45"}) {
        const auto pair =
            with_and_without_rejection(support::repository_scene("paper", pushed("backward-euler", load)), 5);
        if (pair && pair->rejected == 1) {
            ++cases;
            expect_same_course(*pair);
            expect_same_bits(pair->after_rejections, pair->after_none);
        }
    }
    EXPECT_GT(cases, 0) << "no single rejection: the case tests nothing";
}

/// Steps that are not solved are halved like those that err too much, and both are counted.
TEST(AdaptiveRecovery, GoesOnInShorterSteps) {
    const support::Overrides few{"time.tolerance=2e-2", "solver.max_iterations=2",
                                 "boundary.bottom.contact.compliance.stiffness=1e5"};
    const scene::Scene scene = support::repository_scene("isothermal", thrown(few));
    Simulation simulation(scene);
    int failed = 0;
    try {
        while (!simulation.finished()) {
            const State before = simulation.state();
            simulation.advance();
            double reached = before.time;
            for (const Attempt& attempt : simulation.attempts()) {
                EXPECT_NEAR(attempt.end - attempt.size, reached, 1e-14);
                reached = is_taken(attempt) ? attempt.end : reached;
                failed += attempt.outcome == Outcome::failed ? 1 : 0;
            }
            EXPECT_EQ(reached, simulation.state().time);
        }
    } catch (const NumericsError& error) {
        FAIL() << error.what();
    }
    EXPECT_GT(failed, 0) << "no step failed: the case tests nothing";
    EXPECT_EQ(simulation.totals().failed_attempts, failed);
    EXPECT_LE(simulation.totals().energy_residual, 1e-11);
    EXPECT_LE(simulation.totals().force_residual, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Adaptive, testing::Values("backward-euler", "bdf2", "generalized-alpha"),
                         [](const auto& info) { return "scheme_" + std::to_string(info.index); });

}  // namespace
}  // namespace thermocontact::march

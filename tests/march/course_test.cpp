#include "march/course.h"

#include <gtest/gtest.h>

namespace thermocontact::march {
namespace {

StepRule step(double begin, double length, double alpha = 1.0) {
    return {begin, begin + length, length, alpha, alpha * length, -1.0, 1.0, 1};
}

/// One field of two nodes through steps of given lengths from 0, as a simulation takes them.
struct Course {
    State state;
    PastValues past;

    template <typename Field>
    void go(Field&& field, const std::vector<double>& lengths) {
        for (const double length : lengths) {
            const StepRule rule = step(state.time, length);
            Nodal value = field(rule.begin), next = field(rule.end);
            renew_course(past, value, next);
            EXPECT_EQ(value, field(rule.end));
            state.even_steps = even_steps(rule, state);
            state.even_step = length;
            state.time = rule.end;
        }
    }
    template <typename Field>
    Nodal next(Field&& field, double length, double alpha = 1.0, const std::vector<char>& fixed = {0, 0}) {
        Nodal stage{-7, -7};
        if (const auto weights = course_weights(step(state.time, length, alpha), state, past)) {
            follow_course(*weights, field(state.time), past, fixed, {0, 1}, 1, stage);
            EXPECT_EQ(stage[1], -7) << "beyond the range";
            follow_course(*weights, field(state.time), past, fixed, {1, 2}, 1, stage);
        }
        return stage;
    }
};

Nodal cubic(double t) {
    return {1 + t * (2 + t * (3 + t * 4)), 5 - t * t * t};
}

TEST(Course, ThroughFourValuesIsACubic) {
    Course course;
    course.go(cubic, {0.25, 0.25, 0.25});
    const Nodal there = cubic(1), here = cubic(0.75);
    const Nodal found = course.next(cubic, 0.25), half = course.next(cubic, 0.125, 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(found[i], there[i], 1e-13);
        EXPECT_NEAR(half[i], cubic(0.875)[i], 1e-13) << "a step of another length";
        EXPECT_NEAR(course.next(cubic, 0.25, 0.75)[i], here[i] + 0.75 * (there[i] - here[i]), 1e-13)
            << "stage";
    }
}

/// Goes on from a checkpoint of a strategy that keeps no values: as many steps count as have left one since.
TEST(Course, IsOfTheValuesThatWereKept) {
    const auto line = [](double t) -> Nodal { return {2 + 3 * t, t}; };
    Course course;
    course.go(line, {0.25, 0.25, 0.25, 0.25});
    course.past = {};
    EXPECT_EQ(course.next(line, 0.25), (Nodal{-7, -7}));
    course.go(line, {0.25});
    const Nodal found = course.next(line, 0.25), there = line(1.5);
    EXPECT_NEAR(found[0], there[0], 1e-13);
    EXPECT_NEAR(found[1], there[1], 1e-13);
}

/// Values from before the steps were even are forgotten.
TEST(Course, BeginsAnewWithAnotherLength) {
    const auto broken = [](double t) -> Nodal { return t < 1 ? Nodal{9 * t * t, 1} : Nodal{2 + 3 * t, t}; };
    Course course;
    course.go(broken, {0.25, 0.25, 0.25, 0.25, 0.5});
    const Nodal found = course.next(broken, 0.5);
    EXPECT_NEAR(found[0], broken(2)[0], 1e-13);
    EXPECT_NEAR(found[1], 2, 1e-13);
}

TEST(Course, LeavesWhatIsFixedAndKnowsNothingAtFirst) {
    Course course;
    EXPECT_EQ(course.next(cubic, 0.25), (Nodal{-7, -7}));
    course.go(cubic, {0.25});
    const Nodal found = course.next(cubic, 0.25, 1.0, {1, 0});
    EXPECT_EQ(found[0], -7);
    EXPECT_NEAR(found[1], 2 * cubic(0.25)[1] - cubic(0)[1], 1e-13);
}

}  // namespace
}  // namespace thermocontact::march

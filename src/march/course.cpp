#include "march/course.h"

#include <algorithm>

namespace thermocontact::march {

void follow_course(const StepRule& rule, const State& state, const Nodal& y, const Nodal& differences,
                   const std::vector<char>& fixed, Nodal& stage) {
    if (differences.empty() || state.even_steps == 0) {
        return;
    }
    double weights[course_order] = {};  // Newton's: r, r (r + 1)/2, ... after r of the last steps
    double weight = rule.alpha;
    for (int i = 0; i < std::min(course_order, state.even_steps); ++i) {
        weight *= (rule.step / state.even_step + i) / (i + 1);
        weights[i] = weight;
    }
    for (std::size_t dof = 0; dof < stage.size(); ++dof) {
        if (fixed[dof] == 0) {
            double change = 0;
            for (std::size_t i = 0; i < course_order; ++i) {
                change += weights[i] * differences[dof * course_order + i];
            }
            stage[dof] = y[dof] + change;
        }
    }
}

void renew_course(const StepRule& rule, const State& state, const Nodal& y, const Nodal& y_new,
                  Nodal& differences) {
    differences.resize(y.size() * course_order);
    const int known = even_steps(rule, state) - 1;
    for (std::size_t dof = 0; dof < y.size(); ++dof) {
        double change = y_new[dof] - y[dof];
        for (int i = 0; i < course_order; ++i) {
            double& difference = differences[dof * course_order + static_cast<std::size_t>(i)];
            const double before = i < known ? difference : 0.0;
            difference = i <= known ? change : 0.0;
            change -= before;
        }
    }
}

int even_steps(const StepRule& rule, const State& state) {
    return rule.step == state.even_step ? std::min(state.even_steps + 1, course_order + 1) : 1;
}

}  // namespace thermocontact::march

#include "march/course.h"

#include <algorithm>

namespace thermocontact::march {
namespace {

template <int count>
void follow(const CourseWeights& weights, const double* y, const double* const* before, const char* fixed,
            std::ptrdiff_t begin, std::ptrdiff_t end, double* stage) {
#pragma omp simd
    for (std::ptrdiff_t i = begin; i < end; ++i) {
        double value = weights.latest * y[i];
        for (int k = 0; k < count; ++k) {
            value += weights.before[k] * before[k][i];
        }
        stage[i] = fixed[i] == 0 ? value : stage[i];
    }
}

}  // namespace

std::optional<CourseWeights> course_weights(const StepRule& rule, const State& state,
                                            const PastValues& past) {
    if (past[0].empty() || state.even_steps == 0) {
        return std::nullopt;
    }
    CourseWeights weights;
    weights.latest = 1;
    const auto kept = std::ranges::find_if(past, [](const Nodal& values) { return values.empty(); });
    weights.count = std::min(static_cast<int>(kept - past.begin()), state.even_steps);
    double of_difference = rule.alpha;  // Newton's: r, r (r + 1)/2, ... after r of the last steps
    for (int order = 1; order <= weights.count; ++order) {
        of_difference *= (rule.step / state.even_step + (order - 1)) / order;
        weights.latest += of_difference;
        double binomial = 1;  // the difference of that order is sum (-1)^k (order over k) y_k
        for (int k = 1; k <= order; ++k) {
            binomial *= -static_cast<double>(order - k + 1) / k;
            weights.before[k - 1] += of_difference * binomial;
        }
    }
    return weights;
}

void follow_course(const CourseWeights& weights, const Nodal& y, const PastValues& past,
                   const std::vector<char>& fixed, fem::NodeRange range, int components, Nodal& stage) {
    constexpr decltype(&follow<1>) by_count[course_order] = {follow<1>, follow<2>, follow<3>};
    const double* const before[course_order] = {past[0].data(), past[1].data(), past[2].data()};
    by_count[weights.count - 1](weights, y.data(), before, fixed.data(),
                                std::ptrdiff_t{range.begin} * components,
                                std::ptrdiff_t{range.end} * components, stage.data());
}

void renew_course(PastValues& past, Nodal& y, Nodal& y_new) {
    std::rotate(past.begin(), past.end() - 1, past.end());
    past[0].resize(y.size());
    std::swap(past[0], y);
    std::swap(y, y_new);
}

int even_steps(const StepRule& rule, const State& state) {
    return rule.step == state.even_step ? std::min(state.even_steps + 1, course_order + 1) : 1;
}

}  // namespace thermocontact::march

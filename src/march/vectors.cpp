#include "march/vectors.h"

namespace thermocontact::march {
namespace {

constexpr int most_lanes = 12;  ///< loops go through four nodes side by side, and then the others

Translation divided(Translation sum, std::size_t nodes) {
    for (double& number : sum.of) {
        number /= static_cast<double>(nodes);
    }
    return sum;
}

}  // namespace

Translation sum_over_nodes(const std::vector<double>& v, int components, fem::NodeRange range) {
    const int lanes = 4 * components;
    double sums[most_lanes] = {};
    const std::ptrdiff_t end = std::ptrdiff_t{range.end} * components;
    std::ptrdiff_t i = std::ptrdiff_t{range.begin} * components;
    for (; i + lanes <= end; i += lanes) {
#pragma omp simd
        for (int lane = 0; lane < lanes; ++lane) {
            sums[lane] += v[static_cast<std::size_t>(i + lane)];
        }
    }
    for (int lane = 0; i < end; ++i, ++lane) {
        sums[lane] += v[static_cast<std::size_t>(i)];
    }
    Translation total;
    for (int lane = 0; lane < lanes; ++lane) {
        total.of[lane % components] += sums[lane];
    }
    return total;
}

void take_off(const Translation& translation, const std::vector<double>& v, int components,
              fem::NodeRange range, std::vector<double>& result) {
    double numbers[most_lanes];
    const int lanes = 4 * components;
    for (int lane = 0; lane < lanes; ++lane) {
        numbers[lane] = translation.of[lane % components];
    }
    const std::ptrdiff_t end = std::ptrdiff_t{range.end} * components;
    const double* from = v.data();
    double* to = result.data();
    std::ptrdiff_t i = std::ptrdiff_t{range.begin} * components;
    for (; i + lanes <= end; i += lanes) {
#pragma omp simd
        for (int lane = 0; lane < lanes; ++lane) {
            to[i + lane] = from[i + lane] - numbers[lane];
        }
    }
    for (int lane = 0; i < end; ++i, ++lane) {
        to[i] = from[i] - numbers[lane];
    }
}

void centre(std::vector<double>& v, int components) {
    const std::size_t nodes = v.size() / static_cast<std::size_t>(components);
    const fem::NodeRange all{0, static_cast<std::int32_t>(nodes)};
    take_off(divided(sum_over_nodes(v, components, all), nodes), v, components, all, v);
}

void centre(const std::vector<double>& v, int components, const fem::Traversal& traversal,
            std::vector<double>& result) {
    const auto sum = traversal.sum<Translation>(
        [&](fem::NodeRange range) { return sum_over_nodes(v, components, range); });
    const Translation mean = divided(sum, v.size() / static_cast<std::size_t>(components));
    traversal.each([&](fem::NodeRange range, std::size_t) { take_off(mean, v, components, range, result); });
}

}  // namespace thermocontact::march

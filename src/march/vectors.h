/// Arithmetic on nodal vectors through Eigen's expressions.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermocontact::march {

using ConstVectorMap = Eigen::Map<const Eigen::VectorXd>;

inline ConstVectorMap as_eigen(const std::vector<double>& v) {
    return {v.data(), static_cast<Eigen::Index>(v.size())};
}

inline Eigen::Map<Eigen::VectorXd> as_eigen(std::vector<double>& v) {
    return {v.data(), static_cast<Eigen::Index>(v.size())};
}

/// A copy of v.
inline Eigen::VectorXd to_eigen(const std::vector<double>& v) {
    return as_eigen(v);
}

/// Sum of v over all nodes for one component.
inline double component_sum(const Eigen::Ref<const Eigen::VectorXd>& v, int components, int component) {
    return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>(
               v.data() + component, v.size() / components, Eigen::InnerStride<>(components))
        .sum();
}

}  // namespace thermocontact::march

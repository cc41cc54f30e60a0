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

/// Sum of nodal vectors over all nodes [components].
inline Eigen::VectorXd resultant(const ConstVectorMap& v, int components) {
    return Eigen::Map<const Eigen::MatrixXd>(v.data(), components, v.size() / components).rowwise().sum();
}

}  // namespace thermocontact::march

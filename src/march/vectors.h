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

/// A nodal vector [nodes][components] less its mean. A translation strains nothing, but that of a body that
/// has moved far would cost the digits of what does.
inline std::vector<double> centred(const std::vector<double>& v, int components) {
    std::vector<double> result = v;
    const auto nodes = static_cast<Eigen::Index>(v.size()) / components;
    const Eigen::VectorXd mean = resultant(as_eigen(v), components) / static_cast<double>(nodes);
    Eigen::Map<Eigen::MatrixXd>(result.data(), components, nodes).colwise() -= mean;
    return result;
}

}  // namespace thermocontact::march

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

/// Takes the mean off a nodal vector [nodes][components]. A translation strains nothing, but that of a body
/// that has moved far would cost the digits of what does.
inline void centre(std::vector<double>& v, int components) {
    Eigen::Map<Eigen::MatrixXd> columns(v.data(), components,
                                        static_cast<Eigen::Index>(v.size()) / components);
    const Eigen::VectorXd mean = columns.rowwise().mean();
    columns.colwise() -= mean;
}

}  // namespace thermocontact::march

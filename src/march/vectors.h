/// Arithmetic on nodal vectors through Eigen's expressions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fem/traversal.h"

namespace thermocontact::march {

using ConstVectorMap = Eigen::Map<const Eigen::VectorXd>;

inline ConstVectorMap as_eigen(const std::vector<double>& v) {
    return {v.data(), static_cast<Eigen::Index>(v.size())};
}

inline Eigen::Map<Eigen::VectorXd> as_eigen(std::vector<double>& v) {
    return {v.data(), static_cast<Eigen::Index>(v.size())};
}

/// Calls work(dof) for all dofs of a nodal vector [nodes][components]. Calls are beside each other and must
/// not depend on one another.
template <typename Work>
void over_dofs(const fem::Traversal& traversal, int components, Work&& work) {
    traversal.each([&](fem::NodeRange range, std::size_t) {
        const auto end = static_cast<std::size_t>(range.end) * static_cast<std::size_t>(components);
        for (auto i = static_cast<std::size_t>(range.begin) * static_cast<std::size_t>(components); i < end;
             ++i) {
            work(i);
        }
    });
}

/// One number of each component.
struct Translation {
    double of[3] = {};
};

/// The sum of a nodal vector [nodes][components] over a range of nodes.
Translation sum_over_nodes(const std::vector<double>& v, int components, fem::NodeRange range);

/// result := v - translation at the nodes of a range; they may be the same.
void take_off(const Translation& translation, const std::vector<double>& v, int components,
              fem::NodeRange range, std::vector<double>& result);

/// Takes the mean off a nodal vector [nodes][components]. A translation strains nothing, but that of a body
/// that has moved far would cost the digits of what does.
void centre(std::vector<double>& v, int components);

/// The same, v less its mean, into `result`, which has its size already.
void centre(const std::vector<double>& v, int components, const fem::Traversal& traversal,
            std::vector<double>& result);

}  // namespace thermocontact::march

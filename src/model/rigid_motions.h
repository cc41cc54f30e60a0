/// Infinitesimal rigid motions of a body: what strains nothing.
///
/// About the centre c of a body of size s, in x = (X - c)/s: the translations, one a component, then the
/// rotations, one for each plane of two axes a < b: -x_b along a, x_a along b. Three in the plane, six in
/// space; a scalar field has one, the same value everywhere, of which a gradient knows nothing.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thermocontact::model {

inline int rigid_motion_count(int components) {
    return components * (components + 1) / 2;
}

/// One component of all of them at x.
Eigen::RowVectorXd rigid_motions(const Eigen::Vector3d& x, Eigen::Index component, Eigen::Index components);

/// The space that the columns of `basis` [motions][k] span, as k motions in words: "move in x", "turn about
/// (0, 1)", "turn about the axis along z through (0, 1, 0)"; of a scalar field "change alike everywhere".
std::vector<std::string> in_words(const Eigen::MatrixXd& basis, const Eigen::Vector3d& centre, double size,
                                  int components);

}  // namespace thermocontact::model

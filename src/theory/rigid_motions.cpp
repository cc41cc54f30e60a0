#include "theory/rigid_motions.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

namespace thermocontact::theory {
namespace {

/// One component of all rigid motions at x: the translations, then the rotations in each plane of two axes.
Eigen::RowVectorXd motions(const Eigen::Vector3d& x, Eigen::Index component, Eigen::Index dimension) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(dimension * (dimension + 1) / 2);
    result[component] = 1;
    Eigen::Index mode = dimension;
    for (Eigen::Index a = 0; a < dimension; ++a) {
        for (Eigen::Index b = a + 1; b < dimension; ++b, ++mode) {
            result[mode] = component == a ? -x[b] : component == b ? x[a] : 0.0;
        }
    }
    return result;
}

/// Coordinates about the middle of the body, in units of its size.
std::vector<Eigen::Vector3d> normalised(const std::vector<mesh::Point>& points) {
    std::vector<Eigen::Vector3d> result;
    Eigen::AlignedBox3d box;
    for (const mesh::Point& x : points) {
        result.emplace_back(x[0], x[1], x[2]);
        box.extend(result.back());
    }
    for (Eigen::Vector3d& x : result) {
        x = (x - box.center()) / box.diagonal().norm();
    }
    return result;
}

}  // namespace

bool held_rigidly(const fem::Space& space, const std::vector<char>& fixed, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    const std::vector<Eigen::Vector3d> points = normalised(space.nodes);
    Eigen::MatrixXd constraints(std::ranges::count(fixed, 1), dimension * (dimension + 1) / 2);
    Eigen::Index row = 0;
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] != 0) {
            constraints.row(row++) = motions(points[dof / d], static_cast<Eigen::Index>(dof % d), dimension);
        }
    }
    return row > 0 && constraints.colPivHouseholderQr().rank() == constraints.cols();
}

}  // namespace thermocontact::theory

#include "theory/rigid_motions.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

#include "model/rigid_motions.h"

namespace thermocontact::theory {
namespace {

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
    Eigen::MatrixXd constraints(std::ranges::count(fixed, 1), model::rigid_motion_count(dimension));
    Eigen::Index row = 0;
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] != 0) {
            constraints.row(row++) =
                model::rigid_motions(points[dof / d], static_cast<Eigen::Index>(dof % d), dimension);
        }
    }
    return row > 0 && constraints.colPivHouseholderQr().rank() == constraints.cols();
}

}  // namespace thermocontact::theory

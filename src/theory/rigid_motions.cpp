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

bool held_rigidly(const fem::Space& space, const std::vector<char>& fixed, int dimension,
                  const model::Springs* springs) {
    const auto d = static_cast<std::size_t>(dimension);
    const Eigen::Index motions = model::rigid_motion_count(dimension);
    const std::vector<Eigen::Vector3d> points = normalised(space.nodes);
    const auto motion_of = [&](std::size_t dof) {
        return model::rigid_motions(points[dof / d], static_cast<Eigen::Index>(dof % d), dimension);
    };
    std::vector<Eigen::RowVectorXd> constraints;
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] != 0) {
            constraints.push_back(motion_of(dof));
        }
    }
    if (springs != nullptr) {
        springs->visit_stiffness([&](std::span<const std::int32_t> dofs, std::span<const double> tensor) {
            const auto n = static_cast<Eigen::Index>(dofs.size());
            Eigen::MatrixXd R(n, motions);
            for (Eigen::Index i = 0; i < n; ++i) {
                R.row(i) = motion_of(static_cast<std::size_t>(dofs[static_cast<std::size_t>(i)]));
            }
            const Eigen::MatrixXd forces = Eigen::Map<const Eigen::MatrixXd>(tensor.data(), n, n) * R;
            for (Eigen::Index i = 0; i < n; ++i) {
                constraints.emplace_back(forces.row(i) / forces.cwiseAbs().maxCoeff());
            }
        });
    }
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(constraints.size()), motions);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        rows.row(static_cast<Eigen::Index>(i)) = constraints[i];
    }
    return rows.rows() > 0 && rows.colPivHouseholderQr().rank() == motions;
}

}  // namespace thermocontact::theory

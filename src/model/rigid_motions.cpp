#include "model/rigid_motions.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "number.h"

namespace thermocontact::model {
namespace {

constexpr double nothing = 1e-6;  ///< of the largest share in a motion: not worth a word

/// Row-reduces, each row divided by its largest entry: the motions that are told. The last columns go first,
/// so that only as many motions turn as must.
Eigen::MatrixXd reduced(Eigen::MatrixXd rows) {
    Eigen::Index done = 0;
    for (Eigen::Index column = rows.cols() - 1; column >= 0 && done < rows.rows(); --column) {
        Eigen::Index pivot = 0;
        const double largest = rows.col(column).tail(rows.rows() - done).cwiseAbs().maxCoeff(&pivot);
        if (largest <= nothing * rows.cwiseAbs().maxCoeff()) {
            continue;
        }
        rows.row(done).swap(rows.row(done + pivot));
        rows.row(done) /= rows(done, column);
        for (Eigen::Index other = 0; other < rows.rows(); ++other) {
            if (other != done) {
                rows.row(other) -= (rows(other, column) * rows.row(done)).eval();
            }
        }
        ++done;
    }
    return (rows.array().abs() > nothing).select(rows, 0.0);
}

std::string place(const Eigen::VectorXd& x) {
    const double size = x.cwiseAbs().maxCoeff();
    std::string text = "(";
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        text += (i > 0 ? ", " : "") + short_text(std::abs(x[i]) <= nothing * size ? 0.0 : x[i]);
    }
    return text + ")";
}

/// "x", or "(0.6, 0.8)".
std::string direction(const Eigen::VectorXd& v) {
    const Eigen::VectorXd unit = v / v.norm();
    for (Eigen::Index axis = 0; axis < unit.size(); ++axis) {
        if (std::abs(unit[axis]) >= 1 - nothing * nothing) {
            return {"xyz"[axis]};
        }
    }
    return place(unit);
}

std::string in_the_plane(const Eigen::RowVectorXd& motion, const Eigen::Vector3d& centre, double size) {
    const Eigen::Vector2d pole(-motion[1] / motion[2], motion[0] / motion[2]);
    return "turn about " + place(centre.head<2>() + size * pole);
}

std::string in_space(const Eigen::RowVectorXd& motion, const Eigen::Vector3d& centre, double size) {
    const Eigen::Vector3d along = motion.head<3>().transpose(), spin(motion[5], -motion[4], motion[3]);
    const Eigen::Vector3d foot = spin.cross(along) / spin.squaredNorm();
    const bool screws = std::abs(along.dot(spin)) > nothing * spin.squaredNorm();
    return std::string(screws ? "screw" : "turn") + " about the axis along " + direction(spin) + " through " +
           place(centre + size * foot);
}

}  // namespace

Eigen::RowVectorXd rigid_motions(const Eigen::Vector3d& x, Eigen::Index component, Eigen::Index components) {
    Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(rigid_motion_count(static_cast<int>(components)));
    result[component] = 1;
    Eigen::Index motion = components;
    for (Eigen::Index a = 0; a < components; ++a) {
        for (Eigen::Index b = a + 1; b < components; ++b, ++motion) {
            result[motion] = component == a ? -x[b] : component == b ? x[a] : 0.0;
        }
    }
    return result;
}

std::vector<std::string> in_words(const Eigen::MatrixXd& basis, const Eigen::Vector3d& centre, double size,
                                  int components) {
    std::vector<std::string> words;
    const Eigen::MatrixXd motions = reduced(basis.transpose());
    for (Eigen::Index i = motions.rows() - 1; i >= 0; --i) {
        const Eigen::RowVectorXd motion = motions.row(i);
        if (components == 1) {
            words.emplace_back("change alike everywhere");
        } else if (motion.tail(motion.size() - components).isZero(0)) {
            words.push_back("move " +
                            (std::string("along ") + direction(motion.head(components).transpose())));
        } else {
            words.push_back(components == 2 ? in_the_plane(motion, centre, size)
                                            : in_space(motion, centre, size));
        }
    }
    return words;
}

}  // namespace thermocontact::model

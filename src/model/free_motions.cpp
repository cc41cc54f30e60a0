#include "model/free_motions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/rigid_motions.h"
#include "number.h"

namespace thermocontact::model {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double operations = 100;    ///< roundings of one kernel's entry, at most: a quadrature's sum
constexpr std::size_t most_told = 2;  ///< bodies that a message names

/// The basis of those combinations of the columns of `basis` that the symmetric `matrix` [columns][columns]
/// does not resist: eigenvalues that round-off of entries as large as `scale` may make.
Eigen::MatrixXd null_vectors(const Eigen::MatrixXd& basis, const Eigen::MatrixXd& matrix, double scale,
                             double round_off) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((matrix + matrix.transpose()) / 2);
    const auto null = (eigen.eigenvalues().array() <= round_off * scale).count();
    return basis * eigen.eigenvectors().leftCols(null);
}

/// n sums, and coordinates that are known to epsilon |x|, of which normals and levers are differences over a
/// length |x|/farness; a null vector's quotient is the square of their error.
double round_off(double count, double farness) {
    return (count + operations) * epsilon + std::pow(epsilon * farness, 2);
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        text += (i == 0 ? "to " : i + 1 < words.size() ? ", to " : " and to ") + words[i];
    }
    return text;
}

}  // namespace

struct FreeMotions::Quotients {
    std::vector<Eigen::MatrixXd> matrices;  ///< [bodies]
    std::vector<double> scales;             ///< [bodies]: trace of |R|^T |D| |R|
    double count = 0, farness = 0;
    bool acts = false;  ///< whether D is not zero
};

FreeMotions::FreeMotions(const fem::Space& space, const parallel::NodeNumbers& numbers,
                         const parallel::Team& team, const std::vector<char>& fixed, int components)
    : space_(&space),
      numbers_(&numbers),
      team_(&team),
      components_(components),
      bodies_(find_bodies(space, numbers, team)) {
    std::vector<double> extremes(6 * bodies_.count, -std::numeric_limits<double>::infinity());
    for (std::size_t node = 0; node < space.nodes.size(); ++node) {
        double* of_body = extremes.data() + 6 * static_cast<std::size_t>(bodies_.of_nodes[node]);
        for (std::size_t i = 0; i < 3; ++i) {
            of_body[i] = std::max(of_body[i], space.nodes[node][i]);
            of_body[3 + i] = std::max(of_body[3 + i], -space.nodes[node][i]);
        }
    }
    team.max(extremes);
    const int count = rigid_motion_count(components);
    for (std::size_t body = 0; body < bodies_.count; ++body) {
        const Eigen::Map<const Eigen::Vector3d> upper(extremes.data() + 6 * body),
            minus_lower(extremes.data() + 6 * body + 3);
        const double size = (upper + minus_lower).norm(),
                     largest = std::max(upper.cwiseAbs().maxCoeff(), minus_lower.cwiseAbs().maxCoeff());
        free_.push_back(
            {(upper - minus_lower) / 2, size, largest / size, Eigen::MatrixXd::Identity(count, count)});
    }
    hold(fixed);
}

Eigen::MatrixXd FreeMotions::motions_at(std::int32_t node) const {
    const auto n = static_cast<std::size_t>(node);
    const Body& body = free_[static_cast<std::size_t>(bodies_.of_nodes[n])];
    const mesh::Point& p = space_->nodes[n];
    const Eigen::Vector3d x = (Eigen::Vector3d(p[0], p[1], p[2]) - body.centre) / body.size;
    Eigen::MatrixXd rows(components_, rigid_motion_count(components_));
    for (Eigen::Index c = 0; c < components_; ++c) {
        rows.row(c) = rigid_motions(x, c, components_);
    }
    return rows;
}

/// Leaves the motions that vanish at all fixed dofs: the null vectors of the sum of m^T m over these, with m
/// the row of motions there.
void FreeMotions::hold(const std::vector<char>& fixed) {
    const Eigen::Index k = rigid_motion_count(components_), numbers = k * k + 1;
    std::vector<double> sums(static_cast<std::size_t>(numbers) * bodies_.count, 0.0);
    for (std::size_t node = 0; node < space_->nodes.size(); ++node) {
        if (!numbers_->owns(node)) {
            continue;
        }
        double* sum = sums.data() + numbers * bodies_.of_nodes[node];
        const Eigen::MatrixXd rows = motions_at(static_cast<std::int32_t>(node));
        for (Eigen::Index c = 0; c < components_; ++c) {
            if (fixed[node * static_cast<std::size_t>(components_) + static_cast<std::size_t>(c)] != 0) {
                Eigen::Map<Eigen::MatrixXd>(sum, k, k) += rows.row(c).transpose() * rows.row(c);
                sum[k * k] += 1;
            }
        }
    }
    team_->sum(sums);
    for (std::size_t body = 0; body < bodies_.count; ++body) {
        const double* sum = sums.data() + numbers * static_cast<Eigen::Index>(body);
        const Eigen::Map<const Eigen::MatrixXd> gram(sum, k, k);
        free_[body].basis =
            null_vectors(free_[body].basis, gram, gram.trace(), round_off(sum[k * k], free_[body].farness));
    }
}

FreeMotions::Quotients FreeMotions::quotients(const Pieces& pieces) const {
    const Eigen::Index k = rigid_motion_count(components_), numbers = k * k + 1;
    std::vector<double> sums(static_cast<std::size_t>(numbers) * bodies_.count + 1, 0.0);
    double largest[2] = {0, 0};  // |x| over the size of a facet's cell, and |D|
    pieces([&](std::span<const std::int32_t> dofs, std::span<const double> values) {
        const auto n = static_cast<Eigen::Index>(dofs.size());
        const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> D(
            values.data(), n, n);
        if (D.isZero(0)) {
            return;
        }
        const std::int32_t first = dofs.front() / components_;
        const auto body = static_cast<std::size_t>(bodies_.of_nodes[static_cast<std::size_t>(first)]);
        Eigen::MatrixXd R(n, k);
        double extent = 0;
        for (Eigen::Index i = 0; i < n; i += components_) {
            const std::int32_t node = dofs[static_cast<std::size_t>(i)] / components_;
            R.middleRows(i, components_) = motions_at(node);
            for (std::size_t c = 0; c < 3; ++c) {
                extent = std::max(extent, std::abs(space_->nodes[static_cast<std::size_t>(node)][c] -
                                                   space_->nodes[static_cast<std::size_t>(first)][c]));
            }
        }
        double* sum = sums.data() + numbers * static_cast<Eigen::Index>(body);
        Eigen::Map<Eigen::MatrixXd>(sum, k, k) += R.transpose() * D * R;
        sum[k * k] += (R.cwiseAbs().transpose() * D.cwiseAbs() * R.cwiseAbs()).trace();
        sums.back() += 1;
        largest[0] = std::max(largest[0], free_[body].farness * free_[body].size / extent);
        largest[1] = std::max(largest[1], D.cwiseAbs().maxCoeff());
    });
    team_->sum(sums);
    team_->max(largest);
    Quotients result{{}, {}, sums.back(), largest[0], largest[1] > 0};
    for (std::size_t body = 0; body < bodies_.count; ++body) {
        const double* sum = sums.data() + numbers * static_cast<Eigen::Index>(body);
        result.matrices.emplace_back(Eigen::Map<const Eigen::MatrixXd>(sum, k, k));
        result.scales.push_back(sum[k * k]);
    }
    return result;
}

/// Only what these do not resist either.
void FreeMotions::leave(const Quotients& quotients, std::vector<Body>& bodies) {
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        Eigen::MatrixXd& basis = bodies[body].basis;
        if (basis.cols() == 0) {
            continue;
        }
        basis = null_vectors(basis, basis.transpose() * quotients.matrices[body] * basis,
                             quotients.scales[body], round_off(quotients.count, quotients.farness));
    }
}

void FreeMotions::hold(const Springs& springs) {
    leave(quotients([&](const Springs::Piece& visit) { springs.visit_stiffness(visit); }), free_);
}

std::optional<FreeMotions::Found> FreeMotions::left_by(FacetTerm& contact) const {
    std::vector<Body> left = free_;
    const auto any_left = [&] {
        return std::ranges::any_of(left, [](const Body& body) { return body.basis.cols() > 0; });
    };
    bool acts = false;
    for (std::size_t law = 0; law < contact.law_count() && any_left(); ++law) {
        const Quotients of_law =
            quotients([&](const Springs::Piece& visit) { contact.visit_derivative_of(law, visit); });
        acts = acts || of_law.acts;
        leave(of_law, left);
    }
    return any_left() ? std::optional(Found{in_words(left), acts}) : std::nullopt;
}

std::string FreeMotions::in_words(const std::vector<Body>& bodies) const {
    std::string text;
    std::size_t found = 0;
    for (const Body& body : bodies) {
        if (body.basis.cols() == 0 || ++found > most_told) {
            continue;
        }
        const std::string where = bodies.size() == 1
                                      ? ""
                                      : " around (" + short_text(body.centre[0]) + ", " +
                                            short_text(body.centre[1]) +
                                            (components_ == 3 ? ", " + short_text(body.centre[2]) : "") + ")";
        text += std::string(found > 1 ? ", " : "") +
                (components_ == 1 ? "the temperature of the body" : "the body") + where + " is free " +
                listed(model::in_words(body.basis, body.centre, body.size, components_));
    }
    return text + (found > most_told ? ", and " + std::to_string(found - most_told) + " more bodies" : "");
}

}  // namespace thermocontact::model

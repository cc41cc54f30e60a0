#include "theory/energy_space.h"

#include <limits>

namespace thermocontact::theory {
namespace {

/// Factored as a whole, without contact unknowns; nothing where it is singular.
std::optional<solve::CondensedSystem> factor(const fem::BlockMatrix& gram, const std::vector<char>& fixed) {
    const std::vector<char> no_contact(fixed.size() / static_cast<std::size_t>(gram.rows), 0);
    solve::InteriorOrders orders(*gram.graph);
    try {
        return std::optional<solve::CondensedSystem>(
            std::in_place, gram, fixed, no_contact, orders.without(no_contact),
            std::make_shared<solve::Workers>(solve::Workers::available()));
    } catch (const solve::NotPositiveDefinite&) {
        return std::nullopt;
    }
}

}  // namespace

EnergySpace::EnergySpace(fem::BlockMatrix gram, const std::vector<char>& fixed, bool held)
    : gram_(std::move(gram)), x_(fixed.size(), 0.0), y_(fixed.size(), 0.0) {
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] == 0) {
            free_.push_back(static_cast<std::int32_t>(dof));
        }
    }
    if (held) {
        system_ = factor(gram_, fixed);
    }
}

Eigenvalue EnergySpace::largest_quotient(const NodalProduct& B) {
    if (!system_) {
        return {std::numeric_limits<double>::infinity(), 0};
    }
    const NodalProduct A = [this](const std::vector<double>& x, std::vector<double>& y) {
        gram_.multiply(x, y);
    };
    using Vector = Eigen::VectorXd;
    return theory::largest_quotient({static_cast<Eigen::Index>(free_.size()),
                                     [&](const Vector& x, Vector& y) { apply(B, x, y); },
                                     [&](const Vector& x, Vector& y) { apply(A, x, y); },
                                     [&](const Vector& x, Vector& y) { solve(x, y); }});
}

void EnergySpace::apply(const NodalProduct& product, const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    scatter(x);
    product(x_, y_);
    gather(y_, y);
}

void EnergySpace::solve(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    scatter(x);
    system_->condense(x_);
    system_->expand({}, x_);
    gather(x_, y);
}

void EnergySpace::scatter(const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < free_.size(); ++i) {
        x_[static_cast<std::size_t>(free_[i])] = x[static_cast<Eigen::Index>(i)];
    }
}

void EnergySpace::gather(const std::vector<double>& nodal, Eigen::VectorXd& y) const {
    for (std::size_t i = 0; i < free_.size(); ++i) {
        y[static_cast<Eigen::Index>(i)] = nodal[static_cast<std::size_t>(free_[i])];
    }
}

}  // namespace thermocontact::theory

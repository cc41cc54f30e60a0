#include "model/friction_multiplier.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace thermocontact::model {
namespace {

constexpr int multiplier_degree = 2;       ///< as in forms/coulomb.py
constexpr double smallest_weight = 1e-10;  ///< eigenvalues below, of the largest, are round-off

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& gram) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    Eigen::VectorXd inverse = solver.eigenvalues();
    const double smallest = smallest_weight * inverse.maxCoeff();
    for (double& value : inverse) {
        value = value > smallest ? 1 / value : 0.0;
    }
    return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

FrictionMultiplier::FrictionMultiplier(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                       int rule, int degree, int components)
    : components_(components) {
    const fem::LagrangeElement element = fem::make_lagrange(mesh.cell, multiplier_degree);
    facet_nodes_ = element.facet_nodes;
    const auto n = static_cast<std::size_t>(element.node_count);
    shown_.resize(n * static_cast<std::size_t>(components));
    fem::Form gram(fem::find_kernel("coulomb.gram", mesh.cell, degree), mesh, {}, {}, rule);
    std::vector<double> tensor(n * n);
    for (const mesh::Facet& facet : facets) {
        local_.push_back(facet.local);
        std::ranges::fill(tensor, 0.0);
        gram.add_facet(facet, tensor);
        const std::vector<int>& nodes = nodes_of(local_.size() - 1);
        const auto count = static_cast<Eigen::Index>(nodes.size());
        inverses_.push_back(
            pseudo_inverse(Eigen::MatrixXd::NullaryExpr(count, count, [&](Eigen::Index i, Eigen::Index j) {
                return tensor[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]) * n +
                              static_cast<std::size_t>(nodes[static_cast<std::size_t>(j)])];
            })));
    }
    values_.resize(facets.size() * facet_nodes_.front().size() * static_cast<std::size_t>(components));
}

const std::vector<int>& FrictionMultiplier::nodes_of(std::size_t facet) const {
    return facet_nodes_[static_cast<std::size_t>(local_[facet])];
}

std::span<double> FrictionMultiplier::row(std::size_t facet) {
    const std::size_t size = values_.size() / local_.size();
    return {values_.data() + facet * size, size};
}

void FrictionMultiplier::show(std::size_t facet) {
    std::ranges::fill(shown_, 0.0);  // nodes off the facet count by rounding alone: the same in any order
    const double* value = row(facet).data();
    for (const int node : nodes_of(facet)) {
        std::copy_n(value, components_, shown_.begin() + node * components_);
        value += components_;
    }
}

void FrictionMultiplier::take(std::size_t facet, std::span<const double> functional) {
    const std::vector<int>& nodes = nodes_of(facet);
    const std::span<double> values = row(facet);
    const Eigen::MatrixXd& inverse = inverses_[facet];
    std::ranges::fill(values, 0.0);
    const auto d = static_cast<std::size_t>(components_);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            for (std::size_t c = 0; c < d; ++c) {
                values[i * d + c] += inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                                     functional[static_cast<std::size_t>(nodes[j]) * d + c];
            }
        }
    }
}

}  // namespace thermocontact::model

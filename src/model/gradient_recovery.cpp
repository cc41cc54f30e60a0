#include "model/gradient_recovery.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace thermocontact::model {
namespace {

constexpr int most_rings = 4;
/// Of the least squares' columns, relative to the largest: below it, the nodes do not determine the
/// polynomial.
constexpr double independent = 1e-3;

/// Exponents of the monomials up to `degree`, the constant first and the linear ones next.
std::vector<std::array<int, 3>> monomials(int dimension, int degree) {
    std::vector<std::array<int, 3>> result;
    for (int total = 0; total <= degree; ++total) {
        for (int i = total; i >= 0; --i) {
            for (int j = total - i; j >= 0; --j) {
                if (dimension == 3 || i + j == total) {
                    result.push_back({i, j, total - i - j});
                }
            }
        }
    }
    return result;
}

void make_unique(std::vector<std::int32_t>& numbers) {
    std::ranges::sort(numbers);
    const auto repeated = std::ranges::unique(numbers);
    numbers.erase(repeated.begin(), repeated.end());
}

double power(double x, int exponent) {
    double result = 1;
    for (int i = 0; i < exponent; ++i) {
        result *= x;
    }
    return result;
}

double value_of(const std::array<int, 3>& exponents, const std::array<double, 3>& x) {
    return power(x[0], exponents[0]) * power(x[1], exponents[1]) * power(x[2], exponents[2]);
}

double derivative_of(std::array<int, 3> exponents, const std::array<double, 3>& x, std::size_t axis) {
    const int factor = exponents[axis];
    if (factor == 0) {
        return 0;
    }
    --exponents[axis];
    return factor * value_of(exponents, x);
}

}  // namespace

/// The polynomial that fits best, in coordinates from -1 to 1 along each axis about a vertex.
struct GradientRecovery::Fit {
    std::vector<std::array<int, 3>> terms;
    mesh::Point origin{};
    std::array<double, 3> scale{1, 1, 1};
    std::vector<std::int32_t> nodes;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> matrix;  ///< [nodes][terms]

    std::array<double, 3> local(const mesh::Point& x) const {
        return {(x[0] - origin[0]) / scale[0], (x[1] - origin[1]) / scale[1], (x[2] - origin[2]) / scale[2]};
    }

    void compute(const std::vector<mesh::Point>& places, int dimension) {
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
            scale[axis] = 0;
            for (const std::int32_t node : nodes) {
                const double x = places[static_cast<std::size_t>(node)][axis];
                scale[axis] = std::max(scale[axis], std::abs(x - origin[axis]));
            }
        }
        Eigen::MatrixXd values(static_cast<Eigen::Index>(nodes.size()),
                               static_cast<Eigen::Index>(terms.size()));
        for (Eigen::Index i = 0; i < values.rows(); ++i) {
            const auto node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)]);
            const auto x = local(places[node]);
            for (Eigen::Index j = 0; j < values.cols(); ++j) {
                values(i, j) = value_of(terms[static_cast<std::size_t>(j)], x);
            }
        }
        matrix.setThreshold(independent);
        matrix.compute(values);
    }

    bool is_unique() const { return matrix.rank() == static_cast<Eigen::Index>(terms.size()); }

    /// Derivatives of the polynomials with these coefficients [terms][components]: [components] along `axis`.
    Eigen::RowVectorXd derivative(const Eigen::MatrixXd& coefficients, const mesh::Point& x,
                                  std::size_t axis) const {
        Eigen::RowVectorXd weights(static_cast<Eigen::Index>(terms.size()));
        for (Eigen::Index j = 0; j < weights.size(); ++j) {
            weights[j] = derivative_of(terms[static_cast<std::size_t>(j)], local(x), axis) / scale[axis];
        }
        return weights * coefficients;
    }
};

GradientRecovery::GradientRecovery(const mesh::Mesh& mesh, const fem::Space& space,
                                   const std::vector<std::int32_t>& sets)
    : mesh_(&mesh), space_(&space), sites_{space.dofmap.nodes_per_cell, 0, {}} {
    std::unordered_map<std::uint64_t, std::int32_t> numbers;
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::int32_t set = sets.empty() ? 0 : sets[static_cast<std::size_t>(cell)];
        for (const std::int32_t node : space.dofmap.of(cell)) {
            const auto key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(set)) << 32U |
                             static_cast<std::uint64_t>(node);
            const auto [entry, is_new] = numbers.try_emplace(key, sites_.node_count);
            if (is_new) {
                ++sites_.node_count;
                node_of_.push_back(node);
                cells_around_.emplace_back();
            }
            sites_.cell_nodes.push_back(entry->second);
            cells_around_[static_cast<std::size_t>(entry->second)].push_back(cell);
        }
    }
}

std::int32_t GradientRecovery::vertex_site(std::int32_t cell, int vertex) const {
    const int local = space_->element.entities[0][static_cast<std::size_t>(vertex)].front();
    return sites_.of(cell)[static_cast<std::size_t>(local)];
}

/// The cells of the set that share a vertex with some of these, themselves included.
std::vector<std::int32_t> GradientRecovery::neighbours(const std::vector<std::int32_t>& cells) const {
    std::vector<std::int32_t> result;
    for (const std::int32_t cell : cells) {
        for (int v = 0; v < mesh_->vertices_per_cell; ++v) {
            const auto& around = cells_around_[static_cast<std::size_t>(vertex_site(cell, v))];
            result.insert(result.end(), around.begin(), around.end());
        }
    }
    make_unique(result);
    return result;
}

std::vector<std::int32_t> GradientRecovery::nodes_of(const std::vector<std::int32_t>& cells) const {
    std::vector<std::int32_t> result;
    for (const std::int32_t cell : cells) {
        const auto of_cell = space_->dofmap.of(cell);
        result.insert(result.end(), of_cell.begin(), of_cell.end());
    }
    make_unique(result);
    return result;
}

/// With as many rings of cells as it takes to determine the polynomial; of a set that is too small, the
/// smallest of those that fit.
GradientRecovery::Fit GradientRecovery::fit_around(std::int32_t site) const {
    const std::int32_t vertex = node_of_[static_cast<std::size_t>(site)];
    Fit fit;
    fit.terms = monomials(mesh_->dimension, space_->element.degree + 1);
    fit.origin = space_->nodes[static_cast<std::size_t>(vertex)];
    std::vector<std::int32_t> cells = cells_around_[static_cast<std::size_t>(site)];
    for (int ring = 1;; ++ring) {
        fit.nodes = nodes_of(cells);
        std::vector<std::int32_t> more = neighbours(cells);
        const bool last = ring == most_rings || more.size() == cells.size();
        if (last || fit.nodes.size() >= fit.terms.size()) {
            fit.compute(space_->nodes, mesh_->dimension);
            if (last || fit.is_unique()) {
                return fit;
            }
        }
        cells = std::move(more);
    }
}

/// The sites in the middle of the edges from a vertex.
std::vector<std::int32_t> GradientRecovery::edges_at(std::int32_t site) const {
    const fem::LagrangeElement& element = space_->element;
    std::vector<std::int32_t> result;
    for (const std::int32_t cell : cells_around_[static_cast<std::size_t>(site)]) {
        for (std::size_t e = 0; element.degree == 2 && e < element.topology[1].size(); ++e) {
            const std::vector<int>& ends = element.topology[1][e];
            if (vertex_site(cell, ends[0]) == site || vertex_site(cell, ends[1]) == site) {
                result.push_back(sites_.of(cell)[static_cast<std::size_t>(element.entities[1][e].front())]);
            }
        }
    }
    make_unique(result);
    return result;
}

std::vector<std::vector<double>> GradientRecovery::operator()(const std::vector<double>& values,
                                                              int components) const {
    const auto d = static_cast<std::size_t>(mesh_->dimension), sites = node_of_.size();
    std::vector<std::vector<double>> gradients(static_cast<std::size_t>(components),
                                               std::vector<double>(sites * d, 0.0));
    std::vector<char> done(sites, 0);
    for (std::int32_t cell = 0; cell < mesh_->cell_count(); ++cell) {
        for (int v = 0; v < mesh_->vertices_per_cell; ++v) {
            const std::int32_t site = vertex_site(cell, v);
            if (std::exchange(done[static_cast<std::size_t>(site)], 1) != 0) {
                continue;
            }
            const Fit fit = fit_around(site);
            Eigen::MatrixXd here(static_cast<Eigen::Index>(fit.nodes.size()), components);
            for (Eigen::Index i = 0; i < here.rows(); ++i) {
                const std::int32_t node = fit.nodes[static_cast<std::size_t>(i)];
                for (Eigen::Index c = 0; c < components; ++c) {
                    here(i, c) = values[static_cast<std::size_t>(node * components + c)];
                }
            }
            const Eigen::MatrixXd coefficients = fit.matrix.solve(here);
            const auto add = [&](std::int32_t at, double share) {
                const mesh::Point& x =
                    space_->nodes[static_cast<std::size_t>(node_of_[static_cast<std::size_t>(at)])];
                for (std::size_t axis = 0; axis < d; ++axis) {
                    const Eigen::RowVectorXd slopes = fit.derivative(coefficients, x, axis);
                    for (std::size_t c = 0; c < gradients.size(); ++c) {
                        gradients[c][static_cast<std::size_t>(at) * d + axis] +=
                            share * slopes[static_cast<Eigen::Index>(c)];
                    }
                }
            };
            add(site, 1);
            for (const std::int32_t edge : edges_at(site)) {
                add(edge, 0.5);
            }
        }
    }
    return gradients;
}

}  // namespace thermocontact::model

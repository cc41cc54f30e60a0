#include "solve/refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace thermocontact::solve {

Defect::Defect(const fem::BlockMatrix& matrix, const std::vector<char>& fixed, fem::Beside beside)
    : matrix_(&matrix),
      traversal_(*matrix.graph, std::move(beside)),
      roots_(fixed.size()),
      value_(fixed.size()) {
    const auto b = static_cast<std::size_t>(matrix.rows);
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        const auto block =
            static_cast<std::size_t>(matrix.graph->offsets[dof / b]);  // a node itself is first
        const double diagonal = matrix.values[(block * b + dof % b) * b + dof % b];
        roots_[dof] = fixed[dof] == 0 ? std::sqrt(diagonal) : 0.0;
        if (fixed[dof] != 0) {
            fixed_dofs_.push_back(static_cast<std::int32_t>(dof));
        }
    }
}

void Defect::take(const std::vector<double>& rhs, const std::vector<double>& solution) {
    const std::vector<double>* w = &solution;
    const auto has_value = [&](std::int32_t dof) { return solution[static_cast<std::size_t>(dof)] != 0; };
    if (std::ranges::any_of(fixed_dofs_, has_value)) {
        masked_ = solution;
        for (const std::int32_t dof : fixed_dofs_) {
            masked_[static_cast<std::size_t>(dof)] = 0;
        }
        w = &masked_;
    }
    const fem::Product product{.matrix = matrix_, .x = w, .y = &value_, .factor = -1, .from = &rhs};
    traversal_.multiply({&product, 1});
}

double Defect::backward_error(const std::vector<double>& rhs, const std::vector<double>& solution,
                              std::span<const std::int32_t> dofs, std::span<const double> forces) {
    std::vector<double> before(dofs.size());
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        double& value = value_[static_cast<std::size_t>(dofs[i])];
        before[i] = value;
        value -= forces[i];
    }
    const double error = largest_share(rhs, solution);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        value_[static_cast<std::size_t>(dofs[i])] = before[i];
    }
    return error;
}

double Defect::largest_share(const std::vector<double>& rhs, const std::vector<double>& solution) const {
    const std::size_t b = static_cast<std::size_t>(matrix_->rows), count = traversal_.range_count();
    std::vector<double> sizes(count), shares(count), sums(count);
    traversal_.each([&](fem::NodeRange range, std::size_t number) {
        double size = 0;
        const std::size_t end = static_cast<std::size_t>(range.end) * b;
#pragma omp simd reduction(max : size)
        for (std::size_t i = static_cast<std::size_t>(range.begin) * b; i < end; ++i) {
            size = std::max(size, roots_[i] * std::abs(solution[i]));
        }
        sizes[number] = size;
    });
    const double size = *std::ranges::max_element(sizes);
    traversal_.each([&](fem::NodeRange range, std::size_t number) {
        double largest = 0, sum = 0;  // the latter finite only if all shares are
        const std::size_t end = static_cast<std::size_t>(range.end) * b;
#pragma omp simd reduction(max : largest) reduction(+ : sum)
        for (std::size_t i = static_cast<std::size_t>(range.begin) * b; i < end; ++i) {
            const bool counts = roots_[i] > 0 && value_[i] != 0;
            const double scale = counts ? roots_[i] * size + std::abs(rhs[i]) : 1.0;
            const double share = (counts ? std::abs(value_[i]) : 0.0) / scale;
            largest = std::max(largest, share);
            sum += share;
        }
        shares[number] = largest;
        sums[number] = sum;
    });
    const bool finite = std::ranges::all_of(sums, [](double sum) { return std::isfinite(sum); });
    return finite ? *std::ranges::max_element(shares) : std::numeric_limits<double>::infinity();
}

}  // namespace thermocontact::solve

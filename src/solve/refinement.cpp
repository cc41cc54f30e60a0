#include "solve/refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermocontact::solve {

Defect::Defect(const fem::BlockMatrix& matrix, const std::vector<char>& fixed)
    : matrix_(&matrix), roots_(fixed.size()), solution_(fixed.size()), value_(fixed.size()) {
    const auto b = static_cast<std::size_t>(matrix.rows);
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        const auto block =
            static_cast<std::size_t>(matrix.graph->offsets[dof / b]);  // a node itself is first
        const double diagonal = matrix.values[(block * b + dof % b) * b + dof % b];
        roots_[dof] = fixed[dof] == 0 ? std::sqrt(diagonal) : 0.0;
    }
}

void Defect::take(const std::vector<double>& rhs, const std::vector<double>& solution) {
    for (std::size_t i = 0; i < solution.size(); ++i) {
        solution_[i] = roots_[i] > 0 ? solution[i] : 0.0;
    }
    matrix_->multiply(solution_, value_);
    for (std::size_t i = 0; i < rhs.size(); ++i) {
        value_[i] = rhs[i] - value_[i];
    }
}

double Defect::backward_error(const std::vector<double>& rhs, const std::vector<double>& forces) const {
    double size = 0, largest = 0;
    for (std::size_t i = 0; i < roots_.size(); ++i) {
        size = std::max(size, roots_[i] * std::abs(solution_[i]));
    }
    bool finite = true;
    for (std::size_t i = 0; i < roots_.size(); ++i) {
        const double defect = value_[i] - forces[i];
        if (roots_[i] > 0 && defect != 0) {
            const double share = std::abs(defect) / (roots_[i] * size + std::abs(rhs[i]));
            finite = finite && std::isfinite(share);
            largest = std::max(largest, share);
        }
    }
    return finite ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace thermocontact::solve

#include "solve/condition.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermocontact::solve {

double digits_left(double condition) {
    return std::max(0.0, -std::log10(std::numeric_limits<double>::epsilon() * condition));
}

double estimate_norm_1(Eigen::Index n, const LinearMap& apply, const LinearMap& apply_transposed) {
    constexpr int most_columns = 4;
    const auto signs = [](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return v.unaryExpr([](double value) { return value < 0 ? -1.0 : 1.0; });
    };
    Eigen::VectorXd product = apply(Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n)));
    double estimate = product.lpNorm<1>();
    Eigen::VectorXd sign = signs(product);
    Eigen::Index column = -1;
    for (int i = 0; i < most_columns && n > 1; ++i) {
        // the gradient of ||B v||_1: the column that promises most is next, until none promises more
        const Eigen::VectorXd gradient = apply_transposed(sign);
        Eigen::Index best = 0;
        gradient.cwiseAbs().maxCoeff(&best);
        if (best == column) {
            break;
        }
        column = best;
        product = apply(Eigen::VectorXd::Unit(n, column));
        const double found = product.lpNorm<1>();
        if (!(found > estimate)) {
            break;
        }
        estimate = found;
        const Eigen::VectorXd next = signs(product);
        if (next == sign) {
            break;
        }
        sign = next;
    }
    if (n > 1) {  // against matrices that hide their norm from columns
        Eigen::VectorXd alternating(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            alternating[i] =
                (i % 2 == 0 ? 1 : -1) * (1 + static_cast<double>(i) / static_cast<double>(n - 1));
        }
        estimate = std::max(estimate, 2 * apply(alternating).lpNorm<1>() / (3 * static_cast<double>(n)));
    }
    return estimate;
}

double skeel_condition(const LinearMap& solve, const LinearMap& solve_transposed, const Eigen::VectorXd& g,
                       const Eigen::VectorXd& x) {
    const double size = x.size() > 0 ? x.lpNorm<Eigen::Infinity>() : 0.0;
    if (size == 0) {
        return 1.0;
    }
    const double norm = estimate_norm_1(
        x.size(),
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return g.cwiseProduct(solve_transposed(v)); },
        [&](const Eigen::VectorXd& v) { return solve(g.cwiseProduct(v)); });
    const double condition = norm / size;
    return std::isfinite(condition) ? std::max(1.0, condition) : std::numeric_limits<double>::infinity();
}

std::vector<double> product_of_magnitudes(const fem::BlockMatrix& matrix, const std::vector<double>& x) {
    fem::BlockMatrix magnitudes = matrix;
    std::ranges::transform(magnitudes.values, magnitudes.values.begin(),
                           [](double value) { return std::abs(value); });
    std::vector<double> sizes(x.size());
    std::ranges::transform(x, sizes.begin(), [](double value) { return std::abs(value); });
    return magnitudes.multiply(sizes);
}

}  // namespace thermocontact::solve

#include "multigrid/level.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

constexpr int degree = 2;  ///< of the polynomial
constexpr double lowest = 0.15,
                 beyond_largest = 1.1;  ///< its interval, in estimates of the largest eigenvalue
constexpr int lanczos_steps = 10;

/// Entries between -1 and 1 that look random, the same for a node wherever it is held (Wang's hash).
float noise(std::uint32_t number) {
    number = (number ^ 61U) ^ (number >> 16U);
    number *= 9U;
    number ^= number >> 4U;
    number *= 0x27d4eb2dU;
    number ^= number >> 15U;
    return static_cast<float>(number) / 2147483648.0F - 1.0F;
}

double largest_of_tridiagonal(std::vector<double>& diagonal, std::vector<double>& beside) {
    if (diagonal.empty()) {
        return 1;
    }
    const auto n = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd>(diagonal.data(), n),
                                  Eigen::Map<Eigen::VectorXd>(beside.data(), n - 1), Eigen::EigenvaluesOnly);
    const double result = solver.eigenvalues().maxCoeff();
    return std::isfinite(result) && result > 0 ? result : 1;
}

}  // namespace

Level::Level(Matrix matrix, SharedNodes nodes) : matrix_(std::move(matrix)), nodes_(std::move(nodes)) {
    for (std::vector<float>* vector : {&x, &b, &residual, &direction_}) {
        vector->assign(static_cast<std::size_t>(matrix_.node_count()) * stride(), 0.0F);
    }
    largest_ = largest_eigenvalue();
}

std::size_t Level::stride() const {
    return static_cast<std::size_t>(lanes(matrix_.size));
}

/// Of what the processes hold at a shared node, the owner's vector and each one's part of the product add up.
void Level::subtract_product(const std::vector<float>& from, std::vector<float>& to) {
    nodes_.keep_owned(to, stride());
    matrix_.subtract_product(from, to);
    nodes_.add_up(to, stride());
}

/// Conjugate gradients are Lanczos' method: their coefficients give the tridiagonal matrix.
double Level::largest_eigenvalue() {
    for (std::size_t node = 0; node < nodes_.node_count(); ++node) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(matrix_.size); ++c) {
            const auto number = static_cast<std::uint32_t>(nodes_.numbers().global[node]) * 8U;
            residual[node * stride() + c] = noise(number + static_cast<std::uint32_t>(c));
        }
    }
    direction_ = residual;
    std::vector<float>& product = x;  // with a minus
    double square = nodes_.dot(residual, residual, stride()), ratio = 0, length = 1;
    std::vector<double> diagonal, beside;
    for (int step = 0; step < lanczos_steps && square > 0; ++step) {
        std::ranges::fill(product, 0.0F);
        subtract_product(direction_, product);
        const double energy = -nodes_.dot(direction_, product, stride());
        if (!(energy > 0)) {
            break;
        }
        diagonal.push_back(energy / square + ratio / length);
        length = square / energy;
        for (std::size_t k = 0; k < residual.size(); ++k) {
            residual[k] += static_cast<float>(length) * product[k];
        }
        const double next = nodes_.dot(residual, residual, stride());
        ratio = next / square;
        beside.push_back(std::sqrt(ratio) / length);
        for (std::size_t k = 0; k < residual.size(); ++k) {
            direction_[k] = residual[k] + static_cast<float>(ratio) * direction_[k];
        }
        square = next;
    }
    return largest_of_tridiagonal(diagonal, beside);
}

/// x += p(A) residual, where residual = b - A x.
void Level::run_polynomial(Residual wanted) {
    const double top = beyond_largest * largest_, bottom = lowest * largest_;
    const double middle = (top + bottom) / 2, half = (top - bottom) / 2, sigma = middle / half;
    double rho = 1 / sigma;
    auto old = 0.0F, fresh = static_cast<float>(1 / middle);
    std::ranges::fill(direction_, 0.0F);
    for (int k = 0; k < degree; ++k) {
        for (std::size_t at = 0; at < x.size(); ++at) {
            direction_[at] = old * direction_[at] + fresh * residual[at];
            x[at] += direction_[at];
        }
        if (k + 1 == degree && wanted == Residual::not_at_end) {
            return;
        }
        subtract_product(direction_, residual);
        const double next = 1 / (2 * sigma - rho);
        old = static_cast<float>(next * rho);
        fresh = static_cast<float>(2 * next / half);
        rho = next;
    }
}

void Level::smooth_from_zero() {
    std::ranges::fill(x, 0.0F);
    residual = b;
    run_polynomial(Residual::at_end);
}

void Level::smooth() {
    residual = b;
    subtract_product(x, residual);
    run_polynomial(Residual::not_at_end);
}

}  // namespace thermocontact::multigrid

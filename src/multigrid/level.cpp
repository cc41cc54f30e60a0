#include "multigrid/level.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

constexpr int degree = 2;  ///< of the polynomial
constexpr double lowest = 0.15,
                 beyond_largest = 1.1;  ///< its interval, in estimates of the largest eigenvalue
constexpr int lanczos_steps = 10;

/// Blocks of the diagonal; padded columns.
std::vector<float> diagonal_of(const Matrix& A) {
    const std::size_t length = A.block_length();
    std::vector<float> result(static_cast<std::size_t>(A.node_count()) * length);
    for (std::size_t i = 0; i + 1 < A.offsets.size(); ++i) {
        std::copy_n(A.block(static_cast<std::size_t>(A.offsets[i])), length, result.data() + i * length);
    }
    return result;
}

/// The inverse of a symmetric block; of one that is not positive definite, that of its diagonal.
template <int size>
void invert(const float* block, float* inverse) {
    using Square = Eigen::Matrix<double, size, size>;
    Square A;
    for (int c = 0; c < size; ++c) {
        for (int r = 0; r < size; ++r) {
            A(r, c) = block[c * lanes(size) + r];
        }
    }
    const Eigen::LLT<Square> factors(A);
    Square result = factors.solve(Square::Identity());
    if (factors.info() != Eigen::Success || !result.allFinite()) {
        const auto own = A.diagonal().array();
        result = (own > 0).select(own.inverse(), 0.0).matrix().asDiagonal();
    }
    for (int c = 0; c < size; ++c) {
        for (int r = 0; r < size; ++r) {
            inverse[c * lanes(size) + r] = static_cast<float>((result(r, c) + result(c, r)) / 2);
        }
    }
}

/// Entries between -1 and 1 that look random, the same for a node wherever it is held.
float noise(std::uint32_t number) {
    number = (number ^ 61U) ^ (number >> 16U);
    number *= 9U;
    number ^= number >> 4U;
    number *= 0x27d4eb2dU;
    number ^= number >> 15U;
    return static_cast<float>(number) / 2147483648.0F - 1.0F;
}

/// z = D^-1 r
template <int size>
void solve_diagonal(const float* inverse, const std::vector<float>& r, std::vector<float>& z) {
    constexpr std::size_t stride = lanes(size);
    for (std::size_t k = 0; k < r.size(); k += stride, inverse += stride * size) {
        ColumnMap<size>(z.data() + k) = product<size, size>(inverse, r.data() + k);
    }
}

}  // namespace

Level::Level(Matrix matrix, SharedNodes nodes)
    : matrix_(std::move(matrix)), nodes_(std::move(nodes)), diagonal_(diagonal_of(matrix_)) {
    const std::size_t length = matrix_.block_length();
    nodes_.add_up(diagonal_, length);
    inverse_diagonal_.assign(diagonal_.size(), 0.0F);
    with_size(matrix_.size, [&]<int size>() {
        for (std::size_t k = 0; k < diagonal_.size(); k += length) {
            invert<size>(diagonal_.data() + k, inverse_diagonal_.data() + k);
        }
    });
    for (std::vector<float>* vector : {&x, &b, &residual, &direction_, &product_}) {
        vector->assign(vector_length(), 0.0F);
    }
    largest_ = largest_eigenvalue();
}

std::size_t Level::vector_length() const {
    return static_cast<std::size_t>(matrix_.node_count()) * static_cast<std::size_t>(lanes(matrix_.size));
}

void Level::multiply(const std::vector<float>& from, std::vector<float>& to) {
    matrix_.multiply(from, to);
    nodes_.add_up(to, static_cast<std::size_t>(lanes(matrix_.size)));
}

/// Conjugate gradients are Lanczos' method: their coefficients give the tridiagonal matrix.
double Level::largest_eigenvalue() {
    const auto stride = static_cast<std::size_t>(lanes(matrix_.size));
    const auto solve = [&](const std::vector<float>& from, std::vector<float>& to) {
        with_size(matrix_.size,
                  [&]<int size>() { solve_diagonal<size>(inverse_diagonal_.data(), from, to); });
    };
    std::vector<float>& z = x;
    for (std::size_t node = 0; node < nodes_.node_count(); ++node) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(matrix_.size); ++c) {
            const auto number = static_cast<std::uint32_t>(nodes_.numbers().global[node]) * 8U;
            residual[node * stride + c] = noise(number + static_cast<std::uint32_t>(c));
        }
    }
    solve(residual, z);
    direction_ = z;
    double product = nodes_.dot(residual, z, stride), last_ratio = 0, last_length = 1;
    std::vector<double> diagonal, beside;
    for (int step = 0; step < lanczos_steps && product > 0; ++step) {
        multiply(direction_, product_);
        const double energy = nodes_.dot(direction_, product_, stride);
        if (!(energy > 0)) {
            break;
        }
        const double length = product / energy;
        diagonal.push_back(1 / length + last_ratio / last_length);
        for (std::size_t k = 0; k < residual.size(); ++k) {
            residual[k] -= static_cast<float>(length) * product_[k];
        }
        solve(residual, z);
        const double next = nodes_.dot(residual, z, stride);
        last_ratio = next / product;
        last_length = length;
        beside.push_back(std::sqrt(std::max(last_ratio, 0.0)) / length);
        for (std::size_t k = 0; k < residual.size(); ++k) {
            direction_[k] = z[k] + static_cast<float>(last_ratio) * direction_[k];
        }
        product = next;
    }
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

/// x += p(D^-1 A) D^-1 residual, residual = b - A x.
void Level::run_polynomial(Residual wanted) {
    const double top = beyond_largest * largest_, bottom = lowest * largest_;
    const double middle = (top + bottom) / 2, half = (top - bottom) / 2, sigma = middle / half;
    double rho = 1 / sigma;
    auto old = 0.0F, fresh = static_cast<float>(1 / middle);
    for (int k = 0; k < degree; ++k) {
        with_size(matrix_.size, [&]<int size>() {
            constexpr std::size_t stride = lanes(size);
            const float* inverse = inverse_diagonal_.data();
            for (std::size_t at = 0; at < x.size(); at += stride, inverse += stride * size) {
                ColumnMap<size> direction(direction_.data() + at);
                const Column<size> change = product<size, size>(inverse, residual.data() + at);
                direction =
                    k == 0 ? Column<size>(fresh * change) : Column<size>(old * direction + fresh * change);
                ColumnMap<size>(x.data() + at) += direction;
            }
        });
        if (k + 1 == degree && wanted == Residual::not_at_end) {
            return;
        }
        multiply(direction_, product_);
        for (std::size_t at = 0; at < x.size(); ++at) {
            residual[at] -= product_[at];
        }
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
    multiply(x, product_);
    for (std::size_t at = 0; at < x.size(); ++at) {
        residual[at] = b[at] - product_[at];
    }
    run_polynomial(Residual::not_at_end);
}

}  // namespace thermocontact::multigrid

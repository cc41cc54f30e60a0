#include "solve/supernodes.h"

#include <algorithm>

namespace thermocontact::solve {
namespace {

/// Pivots below this share of the diagonal they come from are round-off: the matrix is singular.
constexpr double smallest_pivot = 1e-14;

FactorPointer analyse(const cholmod_sparse& matrix, std::vector<std::int32_t>& order, bool postorder,
                      CholmodCommon& common) {
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = postorder ? 1 : 0;
    common->supernodal = CHOLMOD_SUPERNODAL;
    FactorPointer factor(
        cholmod_analyze_p(const_cast<cholmod_sparse*>(&matrix), order.data(), nullptr, 0, common.get()),
        {&common});
    throw_if_failed(common);
    return factor;
}

bool keeps_tail(const cholmod_factor& factor, std::span<const std::int32_t> order, std::int32_t tail) {
    const auto* refined = static_cast<const std::int32_t*>(factor.Perm);
    std::vector<std::int32_t> now(refined + factor.n - tail, refined + factor.n);
    std::vector<std::int32_t> wanted(order.end() - tail, order.end());
    std::ranges::sort(now);
    std::ranges::sort(wanted);
    return now == wanted;
}

}  // namespace

Supernodes::Supernodes(const SymmetricMatrix& matrix, std::span<const std::int32_t> order, std::int32_t tail)
    : factor_(nullptr, {&common_}) {
    cholmod_sparse input = view(matrix);
    std::vector<std::int32_t> given(order.begin(), order.end());
    factor_ = analyse(input, given, true, common_);
    if (!keeps_tail(*factor_, order, tail)) {
        factor_ = analyse(input, given, false, common_);
    }
    cholmod_factorize(&input, factor_.get(), common_.get());
    throw_if_failed(common_);
    if (common_->status == CHOLMOD_NOT_POSDEF || factor_->minor < factor_->n) {
        throw NotPositiveDefinite{this->order()[factor_->minor]};
    }
    require_pivots(matrix);
}

std::span<const std::int32_t> Supernodes::order() const {
    return {static_cast<const std::int32_t*>(factor_->Perm), factor_->n};
}

Supernode Supernodes::operator[](std::size_t number) const {
    const auto* super = static_cast<const std::int32_t*>(factor_->super);
    const auto* pi = static_cast<const std::int32_t*>(factor_->pi);
    const auto* px = static_cast<const std::int32_t*>(factor_->px);
    const auto* indices = static_cast<const std::int32_t*>(factor_->s);
    return {super[number],
            super[number + 1] - super[number],
            {indices + pi[number], indices + pi[number + 1]},
            static_cast<const double*>(factor_->x) + px[number]};
}

void Supernodes::require_pivots(const SymmetricMatrix& matrix) const {
    for (std::size_t number = 0; number < count(); ++number) {
        const Supernode supernode = (*this)[number];
        for (std::int32_t c = 0; c < supernode.columns; ++c) {
            const double pivot = supernode.column(c)[c];
            const std::int32_t row = order()[static_cast<std::size_t>(supernode.first + c)];
            const auto diagonal = static_cast<std::size_t>(matrix.offsets[static_cast<std::size_t>(row)]);
            if (!(pivot * pivot > smallest_pivot * matrix.values[diagonal])) {
                throw NotPositiveDefinite{row};
            }
        }
    }
}

}  // namespace thermocontact::solve

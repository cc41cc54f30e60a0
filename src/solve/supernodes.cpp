#include "solve/supernodes.h"

#include <algorithm>

namespace thermocontact::solve {
namespace {

FactorPointer analyse(const cholmod_sparse& matrix, bool postorder, CholmodCommon& common) {
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_NATURAL;
    common->postorder = postorder ? 1 : 0;
    common->supernodal = CHOLMOD_SUPERNODAL;
    FactorPointer factor(cholmod_analyze(const_cast<cholmod_sparse*>(&matrix), common.get()), {&common});
    throw_if_failed(common);
    return factor;
}

bool keeps_tail(const cholmod_factor& factor, std::int32_t tail) {
    const auto* order = static_cast<const std::int32_t*>(factor.Perm);
    const auto head = static_cast<std::int32_t>(factor.n) - tail;
    return std::all_of(order + head, order + factor.n, [head](std::int32_t row) { return row >= head; });
}

}  // namespace

Supernodes::Supernodes(const SymmetricMatrix& matrix, std::int32_t tail) : factor_(nullptr, {&common_}) {
    cholmod_sparse input = view(matrix);
    input.sorted = 0;
    factor_ = analyse(input, true, common_);
    if (!keeps_tail(*factor_, tail)) {
        factor_ = analyse(input, false, common_);
    }
}

std::span<const std::int32_t> Supernodes::order() const {
    return {static_cast<const std::int32_t*>(factor_->Perm), factor_->n};
}

Supernode Supernodes::operator[](std::size_t number) const {
    const auto* super = static_cast<const std::int32_t*>(factor_->super);
    const auto* pi = static_cast<const std::int32_t*>(factor_->pi);
    const auto* indices = static_cast<const std::int32_t*>(factor_->s);
    return {
        super[number], super[number + 1] - super[number], {indices + pi[number], indices + pi[number + 1]}};
}

}  // namespace thermocontact::solve

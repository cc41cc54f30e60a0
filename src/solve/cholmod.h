/// CHOLMOD's objects with owners.
#pragma once

#include <SuiteSparse_config.h>
#include <cholmod.h>

#include <memory>

#include "solve/symmetric_matrix.h"

namespace thermocontact::solve {

/// Settings and workspace of CHOLMOD, quiet, with its large blocks in large pages.
class CholmodCommon {
  public:
    CholmodCommon();
    ~CholmodCommon();
    CholmodCommon(const CholmodCommon&) = delete;
    CholmodCommon& operator=(const CholmodCommon&) = delete;

    cholmod_common* get() { return &common_; }
    cholmod_common* operator->() { return &common_; }

  private:
    cholmod_common common_{};
};

/// Throws std::bad_alloc where CHOLMOD found no memory.
void throw_if_failed(CholmodCommon& common);

struct FactorDeleter {
    CholmodCommon* common;
    void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common->get()); }
};
using FactorPointer = std::unique_ptr<cholmod_factor, FactorDeleter>;

/// A view of `matrix` for CHOLMOD; pattern only where it holds no values.
inline cholmod_sparse view(const SymmetricMatrix& matrix) {
    cholmod_sparse result{};
    result.nrow = result.ncol = static_cast<std::size_t>(matrix.size);
    result.nzmax = matrix.rows.size();
    result.p = const_cast<std::int32_t*>(matrix.offsets.data());
    result.i = const_cast<std::int32_t*>(matrix.rows.data());
    result.x = matrix.values.empty() ? nullptr : const_cast<double*>(matrix.values.data());
    result.stype = -1;
    result.itype = CHOLMOD_INT;
    result.xtype = matrix.values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
    result.dtype = CHOLMOD_DOUBLE;
    result.sorted = result.packed = 1;
    return result;
}

}  // namespace thermocontact::solve

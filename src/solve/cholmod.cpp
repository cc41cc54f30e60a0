#include "solve/cholmod.h"

#include <new>

#include "solve/huge_pages.h"

namespace thermocontact::solve {

CholmodCommon::CholmodCommon() {
#if SUITESPARSE_MAIN_VERSION < 7
    SuiteSparse_config.malloc_func = allocate_huge;
#else
    SuiteSparse_config_malloc_func_set(allocate_huge);
#endif
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
}

CholmodCommon::~CholmodCommon() {
    cholmod_finish(&common_);
}

void throw_if_failed(CholmodCommon& common) {
    if (common->status == CHOLMOD_OUT_OF_MEMORY || common->status == CHOLMOD_TOO_LARGE) {
        throw std::bad_alloc();
    }
}

}  // namespace thermocontact::solve

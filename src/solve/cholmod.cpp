#include "solve/cholmod.h"

#include <new>

#include "solve/huge_pages.h"

/// OpenMP's parallel regions, run by the thread that meets them; this definition comes before libgomp's.
///
/// CHOLMOD's supernodal factorisation opens tens of thousands of regions around loops of a few entries, for
/// four threads whatever OMP_NUM_THREADS says, and libgomp enters the kernel at the end of each, even of one
/// thread: 40 % of the factorisation at 16 thousand nodes. Nothing else in the process uses OpenMP. A region
/// run outside any team is what the standard calls inactive: omp_get_num_threads() is 1 in it, and its loops
/// run whole.
extern "C" void GOMP_parallel(void (*region)(void*), void* data, unsigned /*threads*/, unsigned /*flags*/) {
    region(data);
}

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

#include "app/blas_threads.h"

#include <cstdlib>

extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace thermocontact::app {

void keep_blas_to_one_thread() {
    if (openblas_set_num_threads != nullptr && std::getenv("OPENBLAS_NUM_THREADS") == nullptr) {
        openblas_set_num_threads(1);
    }
}

}  // namespace thermocontact::app

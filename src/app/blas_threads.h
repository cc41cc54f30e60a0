/// How many threads BLAS takes.
#pragma once

namespace thermocontact::app {

/// One, unless OPENBLAS_NUM_THREADS says otherwise, where BLAS is OpenBLAS: products of a contact's size gain
/// nothing from more, and the others spin for milliseconds after each, on the cores of the solver's threads
/// and of other processes. Newton-krylov takes twice the processor time with them.
void keep_blas_to_one_thread();

}  // namespace thermocontact::app

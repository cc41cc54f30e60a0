/// PETSc's error codes as exceptions.
#pragma once

#include <petscsys.h>

#include <string>

#include "error.h"

namespace thermocontact::petsc {

/// Throws SystemError with PETSc's text where the code is not zero.
inline void check(PetscErrorCode code) {
    if (code != 0) {
        const char* text = nullptr;
        PetscErrorMessage(code, &text, nullptr);
        throw SystemError("PETSc: " + std::string(text != nullptr ? text : "error " + std::to_string(code)));
    }
}

}  // namespace thermocontact::petsc

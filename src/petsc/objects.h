/// PETSc's objects with owners.
#pragma once

#include <petscksp.h>

#include <utility>

namespace thermocontact::petsc {

template <typename Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
  public:
    Owned() = default;
    Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(object_, other.object_);
        return *this;
    }
    ~Owned() {
        if (object_ != nullptr) {
            destroy(&object_);
        }
    }
    Object get() const { return object_; }
    operator Object() const { return object_; }

    /// For PETSc's functions that create.
    Object* put() { return &object_; }

  private:
    Object object_ = nullptr;
};

using Matrix = Owned<Mat, MatDestroy>;
using Vector = Owned<Vec, VecDestroy>;
using Solver = Owned<KSP, KSPDestroy>;
using Scatter = Owned<VecScatter, VecScatterDestroy>;
using Indices = Owned<IS, ISDestroy>;
using NearNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

}  // namespace thermocontact::petsc

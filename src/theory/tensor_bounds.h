/// Bounds of the material tensors as operators: what ellipticity and boundedness ask for.
#pragma once

#include "scene/scene.h"

namespace thermocontact::theory {

/// smallest |x|^2 <= T x : x, |T x| <= largest |x|, both sharp.
struct Bounds {
    double smallest = 0;
    double largest = 0;
};

/// On symmetric matrices with their Euclidean norm: Voigt's form with its shear scaled.
Bounds bounds_of(const scene::VoigtTensor& tensor, int dimension);

/// On vectors.
Bounds bounds_of(const scene::SymmetricTensor& tensor);

/// (T : T)^(1/2).
double norm_of(const scene::SymmetricTensor& tensor);

}  // namespace thermocontact::theory

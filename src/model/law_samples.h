/// What the laws of the body that a scene has from files are at the points of their rule, where operators and
/// loads take them (forms/at_points.py).
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fem/form.h"
#include "scene/scene.h"

namespace thermocontact::model {

class LawSamples {
  public:
    /// `form`: "E" | "Visc" | "q0" | "f".
    LawSamples(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form);

    /// The values [points][size] in a cell at time t (s), until the next call.
    std::span<const double> at(std::int32_t cell, double t = 0);

    std::size_t size() const { return size_; }

  private:
    std::size_t size_;
    fem::Form law_, weights_;
    std::vector<double> values_, of_points_;
};

/// "laws/wood.py:12", for messages.
std::string place_of(const scene::Law& law);

/// Constants of the body force of a law file, with the time "t".
fem::Constants body_force_constants(const scene::Scene& scene);

/// Constants of heat sources of a law file by region, with the time "t".
std::vector<fem::Constants> source_constants(const scene::Scene& scene, const mesh::Mesh& mesh);

/// Of a symmetric tensor over cells, on symmetric matrices with their Euclidean norm.
struct TensorRange {
    double smallest = std::numeric_limits<double>::infinity();  ///< eigenvalue
    double largest = 0;                                         ///< |eigenvalue|
};

/// Of elasticity ("E") or viscosity ("Visc") of a law file over these cells. Throws SceneError as
/// check_own_tensors.
TensorRange range_of_own_tensor(const scene::Scene& scene, const mesh::Mesh& mesh, const std::string& form,
                                std::span<const std::int32_t> cells);

/// Throws SceneError "FILE:LINE: why" where the elasticity or viscosity of a law file is not finite, not
/// symmetric (E_ijkl = E_klij: without it there is no energy), not positive semidefinite (it would give
/// energy off for ever), or where it has a stress that plane strain excludes. Looks at every point of every
/// cell.
void check_own_tensors(const scene::Scene& scene, const mesh::Mesh& mesh);

}  // namespace thermocontact::model

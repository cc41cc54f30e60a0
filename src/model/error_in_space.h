/// How much the mesh lacks: recovered gradients (gradient_recovery.h) against those of the discrete fields,
/// in the norms of energy (forms/estimate.py), after O. C. Zienkiewicz and J. Z. Zhu, Int. J. Numer. Methods
/// Eng. 24 (1987) 337-357. Deformation is that of the displacement by elasticity; of a body without, that of
/// the velocity by viscosity.
#pragma once

#include <vector>

#include "fem/space.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// Of one field: the squares of the estimated error, and of the field itself, each in its norm of energy.
struct FieldEstimate {
    std::vector<double> squares;  ///< [cells]; empty where the scene has no such energy
    double error = 0, size = 0;   ///< norms over the body
    double noise = 0;             ///< what round-off of the nodal values is at most worth in that norm
};

struct ErrorInSpace {
    FieldEstimate deformation;  ///< J^(1/2) or W^(1/2) (per m in 2D)
    FieldEstimate heat;         ///< (W K)^(1/2) likewise
};

/// Fields [nodes][components] of the whole mesh; absent ones are empty.
ErrorInSpace estimate_error(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                            const std::vector<double>& displacement, const std::vector<double>& velocity,
                            const std::vector<double>& temperature);

/// Whether the scene has an energy to go by.
bool has_energy(const scene::Scene& scene);

}  // namespace thermocontact::model

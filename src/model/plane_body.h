/// A body that is isotropic and the same everywhere, in the plane: all that its balance takes of strains is
/// read from one matrix (fem/plane_rows.h).
#pragma once

#include <optional>

#include "fem/plane_rows.h"
#include "scene/scene.h"

namespace thermocontact::model {

struct PlaneBody {
    fem::BlockMatrix divergences;  ///< (div u, div v)
    fem::Isotropic elasticity, viscosity;
};

/// Nothing for other bodies, and where elasticity or viscosity is absent: there is less to share.
std::optional<PlaneBody> plane_body(const scene::Scene& scene, const mesh::Mesh& mesh,
                                    const fem::Space& space, const fem::NodeGraph& graph);

}  // namespace thermocontact::model

/// What friction dissipates as heat of the body: of each surface the share that its scene says.
#pragma once

#include <memory>
#include <vector>

#include "fem/form.h"
#include "model/contact_surface.h"

namespace thermocontact::model {

/// Where the body is and how it moves, [nodes][d]; null without mechanics. The addresses stay.
struct Motion {
    const std::vector<double>* displacement = nullptr;  ///< m
    const std::vector<double>* velocity = nullptr;      ///< m/s
};

class FrictionHeat {
  public:
    /// Keeps references to surfaces, mesh and space.
    FrictionHeat(const ContactSurfaces& surfaces, const mesh::Mesh& mesh, const fem::Space& space,
                 int dimension, const Motion& motion);

    /// Whether no surface has any.
    bool empty() const { return sources_.empty(); }

    /// Adds the heat of the present motion to `source` [nodes], W (W/m in 2D), tested with the functions of
    /// the space. Where friction is exact, it is that which the multipliers have led to.
    void add_to(std::vector<double>& source);

  private:
    struct Source {
        const ContactSurface* surface;
        std::unique_ptr<fem::Form> form;
    };

    const fem::Space* space_;
    std::vector<Source> sources_;
};

}  // namespace thermocontact::model

#include "model/friction_heat.h"

#include "fem/block_matrix.h"
#include "model/physics.h"

namespace thermocontact::model {

FrictionHeat::FrictionHeat(const ContactSurfaces& surfaces, const mesh::Mesh& mesh, const fem::Space& space,
                           int dimension, const Motion& motion)
    : space_(&space) {
    for (const auto& surface : surfaces) {
        if (!surface->laws.friction || surface->laws.friction->heat_share == 0) {
            continue;
        }
        fem::Fields fields{{"u_old", {motion.displacement, dimension, &space.dofmap}},
                           {"w", {motion.velocity, dimension, &space.dofmap}},
                           {"v_F", surface->velocity_of_foundation(space, dimension)},
                           {"g", {&surface->gap, 1, &space.dofmap}}};
        if (surface->multiplier) {
            fields["lam"] = surface->multiplier->on_facet();
        }
        // with k = 0 the displacement u_old + k w of the friction forms is that of the motion
        auto kernel = fem::kernel_in_force(surface->multiplier ? "coulomb.heat" : "friction.heat", mesh.cell,
                                           space.element.degree, surface->kernels);
        auto form = std::make_unique<fem::Form>(std::move(kernel), mesh,
                                                contact_constants(surface->laws, 0.0), fields, surface->rule);
        sources_.push_back({surface.get(), std::move(form)});
    }
}

void FrictionHeat::add_to(std::vector<double>& source) {
    for (const Source& of : sources_) {
        const std::vector<mesh::Facet>& facets = of.surface->facets;
        if (of.surface->multiplier) {
            of.form->set_constant("gamma", of.surface->multiplier->slip_stiffness);
        }
        for (std::size_t i = 0; i < facets.size(); ++i) {
            if (of.surface->multiplier) {
                of.surface->multiplier->show(i);
            }
            fem::assemble_facets(*of.form, {&facets[i], 1}, space_->dofmap, 1, source);
        }
    }
}

}  // namespace thermocontact::model

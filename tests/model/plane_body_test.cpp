#include "model/plane_body.h"

#include <gtest/gtest.h>

#include "model/physics.h"
#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

std::optional<PlaneBody> body_of(const support::Discretisation& at) {
    return plane_body(at.scene, at.mesh, at.space, at.graph);
}

/// What it makes of the tensors are the scene's stiffness and damping.
TEST(PlaneBody, HoldsTheScenesTensors) {
    for (const char* plane : {"stress", "strain"}) {
        support::Discretisation at(support::repository_scene(
            "paper-isotropic",
            {"mesh.cells=[3,4]", std::string("material.elasticity.plane=\"") + plane + "\"",
             "material.viscosity.trace=3"}));
        const auto body = body_of(at);
        ASSERT_TRUE(body) << plane;
        for (const auto& [form, tensor] : {std::pair("elasticity.stiffness", body->elasticity),
                                           std::pair("viscosity.damping", body->viscosity)}) {
            const auto expected =
                support::as_vector(fem::assemble_matrix({fem::find_kernel(form, at.mesh.cell, 1), at.mesh,
                                                         body_constants(at.scene)},
                                                        at.space, at.graph, 2, 2)
                                       .values);
            const auto found = support::as_vector(fem::isotropic_matrix(body->divergences, tensor).values);
            EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.cwiseAbs().maxCoeff())
                << form;  // sums over two cells, of a few terms each
        }
    }
}

TEST(PlaneBody, IsNotFoundWhereThereIsNone) {
    const auto found = [](const char* scene, const support::Overrides& overrides) {
        return body_of(support::Discretisation(support::repository_scene(scene, overrides))).has_value();
    };
    EXPECT_TRUE(found("paper-isotropic", {"mesh.cells=[2,2]"}));
    EXPECT_FALSE(found("anisotropic", {"mesh.cells=[2,2]"}));
    EXPECT_FALSE(found("elastic", {"mesh.cells=[2,2]"}));    // without viscosity
    EXPECT_FALSE(found("box", {"mesh.cells=[1,1,1]"}));      // in space
    EXPECT_FALSE(found("heat-only", {"mesh.cells=[2,2]"}));  // no body that moves
    scene::Scene scene = support::repository_scene("paper-isotropic", {"mesh.cells=[2,2]"});
    scene.material->viscosity->matrix[8] *= 1 + 1e-12;  // nearly isotropic
    EXPECT_FALSE(body_of(support::Discretisation(scene)));
    scene = support::repository_scene("paper-isotropic", {"mesh.cells=[2,2]"});
    scene.regions["left"].material = scene.material;
    EXPECT_FALSE(body_of(support::Discretisation(scene)));
    scene.regions.clear();
    scene.material->elasticity->own = scene::Law{};
    EXPECT_FALSE(body_of(support::Discretisation(scene)));
}

}  // namespace
}  // namespace thermocontact::model

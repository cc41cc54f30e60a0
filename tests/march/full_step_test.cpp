#include "full_step.h"

#include <gtest/gtest.h>

#include "march/simulation.h"

namespace thermocontact::march {
namespace {

struct Case {
    std::string name, scene;
    support::Overrides overrides;
};

const std::string bottom = "boundary.bottom.contact.";

std::vector<Case> cases() {
    const std::string coarse = "mesh.cells=[4,3]";
    return {
        {"paper", "paper", {coarse}},
        {"paper_isotropic", "paper-isotropic", {coarse}},
        {"paper_crossed", "paper", {coarse, "mesh.diagonal=\"crossed\""}},
        {"paper_other_heat_of_strain",
         "paper-isotropic",
         {coarse, "heat.strain_heating=[[-0.5,-0.5],[-0.5,-0.5]]"}},
        {"paper_quadratic", "paper-isotropic", {coarse, "space.degree=2"}},
        {"paper_finite_limit",
         "paper-isotropic",
         {coarse, bottom + "conductance.limit=4.0", bottom + "conductance.coefficient=30.0"}},
        {"paper_sharp_friction", "paper", {coarse, bottom + "friction.regularisation=1e-8"}},
        {"paper_quadratic_law", "paper", {coarse, bottom + "compliance.exponent=2"}},
        {"paper_vertex_rule", "paper", {coarse, bottom + "quadrature=\"vertex\""}},
        {"anisotropic", "anisotropic", {"mesh.cells=[3,2]"}},
        {"paper_on_a_belt",
         "paper",
         {coarse, bottom + "foundation_velocity=[\"0.3 - 2*x*t\",0.7]", bottom + "friction.heat_share=0.4"}},
        {"anisotropic_with_all_heat",
         "anisotropic",
         {"mesh.cells=[3,2]", bottom + "foundation_velocity=[0.5,0.0]", bottom + "friction.heat_share=1",
          "heat.strain_rate_heating=[[-0.5,0.2],[0.2,0.8]]", "boundary.left.convection.coefficient=2.5",
          "boundary.left.convection.ambient_temperature=\"3 - y*t\""}},
        {"anisotropic_on_springs",
         "anisotropic",
         {"mesh.cells=[3,2]", "boundary.left.spring.stiffness=[[30,10],[10,20]]",
          "boundary.left.spring.anchor=[\"0.1*t*y\",\"0.2 - t\"]", "boundary.bottom.spring.stiffness=5"}},
        {"elastic", "elastic", {coarse}},
        {"frictionless", "frictionless", {coarse}},
        {"heat_only", "heat-only", {"mesh.cells=[6,3]"}},
        {"isothermal", "isothermal", {coarse}},
        {"no_contact", "no-contact", {coarse}},
        {"quasi_static", "quasi-static", {coarse}}};
}

class Step : public testing::TestWithParam<Case> {};

/// Both solve to 1e-13 of the terms in the balance; the systems' condition numbers are of the order of 10 to
/// 100.
void expect_equal(const std::vector<double>& found, const std::vector<double>& expected, const char* field) {
    ASSERT_EQ(found.size(), expected.size()) << field;
    if (!found.empty()) {
        const Eigen::VectorXd difference = support::as_vector(found) - support::as_vector(expected);
        EXPECT_LE(difference.cwiseAbs().maxCoeff(),
                  1e-11 * support::as_vector(expected).cwiseAbs().maxCoeff())
            << field;
    }
}

TEST_P(Step, OfCondensationEqualsTheFullNewtonSolve) {
    support::Overrides overrides = GetParam().overrides;
    overrides.push_back("solver.tolerance=1e-13");
    const scene::Scene scene = support::repository_scene(GetParam().scene, overrides);
    const double k = scene.time.end / scene.time.steps;
    Simulation simulation(scene);
    FullStep full(scene, k);
    for (int step = 1; step <= 4; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const State expected = full(simulation.state(), scene.time.end * step / scene.time.steps);
        simulation.advance();
        expect_equal(simulation.state().displacement, expected.displacement, "displacement");
        expect_equal(simulation.state().velocity, expected.velocity, "velocity");
        expect_equal(simulation.state().temperature, expected.temperature, "temperature");
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Step, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::march

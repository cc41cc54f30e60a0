#include "theory/hypotheses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "theory/law_bounds.h"
#include "theory/tensor_bounds.h"

namespace thermocontact::theory {
namespace {

using support::Discretisation;
using support::Overrides;

/// Data that the theory covers.
const std::string covered = R"(
mesh.cells = [4, 4]
time = {end = 1.0, steps = 4}
material = {density = 1.0, elasticity = {young = 2.0, poisson = 0.1}, viscosity = {trace = 10.0, shear = 10.0}}
heat = {capacity = 1.0, conductivity = 1.0, thermal_stress = 1.0, strain_heating = 1.0, source = "x*t"}
load.body_force = [0.0, -1.0]
boundary.top.displacement = [0.0, 0.0]
boundary.top.temperature = 0.0
boundary.left.traction = [1.4, 0.4]
boundary.bottom.contact.gap = "0.01*x"
boundary.bottom.contact.compliance = {stiffness = 0.05}
boundary.bottom.contact.friction = {coefficient = 0.2, regularisation = 1e-3}
boundary.bottom.contact.conductance = {coefficient = 0.5, onset = 1e-3, foundation_temperature = "10*t"}
)";

std::vector<Condition> judged(const Discretisation& at) {
    const std::vector<Piece> pieces = pieces_of(at.scene, at.mesh);
    return judge(at.scene, pieces, find_constants(at.scene, pieces, at.mesh, at.space),
                 take_samples(at.scene, pieces, at.mesh, at.space));
}

/// The labels of the conditions with this verdict.
std::vector<std::string> labels(const std::vector<Condition>& conditions, Verdict verdict) {
    std::vector<std::string> result;
    for (const Condition& condition : conditions) {
        if (condition.verdict == verdict) {
            result.push_back(condition.label);
        }
    }
    return result;
}

using Labels = std::vector<std::string>;

TEST(Hypotheses, AllHold) {
    const auto conditions = judged(Discretisation(covered));
    EXPECT_EQ(labels(conditions, Verdict::fails), Labels{});
    EXPECT_EQ(labels(conditions, Verdict::not_applicable), Labels{});
    EXPECT_EQ(
        labels(conditions, Verdict::holds),
        (Labels{"(2.3)",    "(2.4)",        "(2.5)",    "(2.7)",    "(2.12)",       "(2.13)",     "(H1 i)",
                "(H1 ii)",  "(H1 iii, iv)", "(H2 i)",   "(H2 ii)",  "(H2 iii, iv)", "(H3 i)",     "(H3 ii)",
                "(H3 iii)", "(H4 i)",       "(H4 ii)",  "(H5 i)",   "(H5 ii)",      "(H6 i)",     "(H6 ii)",
                "(H6 ii)",  "(H6 ii)",      "(H6 iii)", "(H7 i)",   "(H7 ii)",      "(H8 i-iii)", "(H8 iv)",
                "(2.23)",   "(2.23 op)",    "(2.23)",   "(2.23 op)"}));
}

struct Case {
    std::string name;
    Overrides overrides;
    Labels failing;
};

class Broken : public testing::TestWithParam<Case> {};

/// One change of the data breaks what it should, and nothing else.
TEST_P(Broken, ByOneChange) {
    EXPECT_EQ(labels(judged(Discretisation(covered, GetParam().overrides)), Verdict::fails),
              GetParam().failing);
}

const std::string friction = "boundary.bottom.contact.friction.";
const std::vector<Case> cases{
    {"viscosity", {"material.viscosity.shear=0.0"}, {"(H1 i)"}},
    {"elasticity",
     {"material.elasticity={tensor=[[1.0,1.0,0.0],[1.0,1.0,0.0],[0.0,0.0,1.0]]}"},
     {"(H2 i)", "(2.23)", "(2.23 op)"}},
    {"conductivity", {"heat.conductivity=[[1.0,1.0],[1.0,1.0]]"}, {"(H3 ii)", "(2.23)", "(2.23 op)"}},
    {"moving_clamp", {"boundary.top.displacement=[0.0,\"0.1*t\"]"}, {"(2.5)"}},
    {"warm_side", {"boundary.top.temperature=\"t > 0.9 ? 1 : 0\""}, {"(2.7)"}},
    {"gap", {"boundary.bottom.contact.gap=\"0.01 - 0.02*(x > 0.9)\""}, {"(H6 ii)"}},
    {"infinite_load", {"load.body_force=[0.0,\"1/(t - 0.5)\"]"}, {"(H6 i)"}},
    {"infinite_foundation",
     {"boundary.bottom.contact.conductance.foundation_temperature=\"1/(t - 0.5)\""},
     {"(H6 ii)"}},
    {"initial", {"initial.velocity=[\"y\",0.0]"}, {"(H6 ii)"}},
    {"exponent", {"boundary.bottom.contact.compliance.exponent=1.5"}, {"(H8 iv)", "(2.23)", "(2.23 op)"}},
    {"stiff_foundation", {"boundary.bottom.contact.compliance.stiffness=1e4"}, {"(2.23)", "(2.23 op)"}},
    {"conducting_foundation",
     {"boundary.bottom.contact.conductance.coefficient=2.0"},
     {"(2.23)", "(2.23 op)"}},
    {"conducting_foundation_on_a_body_that_conducts_along_it",
     {"boundary.bottom.contact.conductance.coefficient=1.5", "heat.conductivity=[[1.0,0.0],[0.0,4.0]]"},
     {"(2.23)"}},
};
INSTANTIATE_TEST_SUITE_P(Changes, Broken, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

/// A body that is not held: neither Korn's inequality nor a trace constant.
TEST(Hypotheses, OfABodyThatNothingHolds) {
    std::string text = covered;
    for (const std::string line :
         {"boundary.top.displacement = [0.0, 0.0]\n", "boundary.top.temperature = 0.0\n"}) {
        text.erase(text.find(line), line.size());
    }
    EXPECT_EQ(
        labels(judged(Discretisation(text)), Verdict::fails),
        (Labels{"(2.12)", "(2.13)", "(H4 ii)", "(H5 ii)", "(2.23)", "(2.23 op)", "(2.23)", "(2.23 op)"}));
}

TEST(Hypotheses, OfHeatAlone) {
    const auto conditions = judged(Discretisation(R"(
mesh.cells = [4, 4]
time = {end = 1.0, steps = 4}
heat.conductivity = 1.0
boundary.top.temperature = 0.0
)"));
    EXPECT_EQ(labels(conditions, Verdict::fails), (Labels{"(2.3)", "(2.4)"}));
    EXPECT_EQ(
        labels(conditions, Verdict::not_applicable),
        (Labels{"(H1), (H2)", "(H4)", "(H5)", "(H6 ii)", "(H6 iii)", "(H7)", "(H8)", "(2.23)", "(2.23)"}));
}

TEST(Hypotheses, OfMechanicsAlone) {
    const auto conditions = judged(Discretisation(R"(
mesh.cells = [4, 4]
time = {end = 1.0, steps = 4}
material.elasticity = {young = 2.0, poisson = 0.1}
boundary.top.displacement = [0.0, 0.0]
boundary.bottom.contact.compliance.stiffness = 0.01
)"));
    EXPECT_EQ(labels(conditions, Verdict::fails), (Labels{"(2.3)", "(2.4)", "(H1 i)"}));
    EXPECT_EQ(labels(conditions, Verdict::not_applicable),
              (Labels{"(H3)", "(H4)", "(H5)", "(H7)", "(2.23)"}));
}

/// The paper's own data: (H3 ii) and both halves of (2.23); with K = I, only the compliance's half.
TEST(Hypotheses, OfThePaper) {
    const Discretisation literal(support::repository_scene("paper")),
        isotropic(support::repository_scene("paper-isotropic"));
    const auto conditions = judged(literal);
    EXPECT_EQ(labels(conditions, Verdict::fails),
              (Labels{"(H3 ii)", "(2.23)", "(2.23 op)", "(2.23)", "(2.23 op)"}));
    EXPECT_EQ(labels(judged(isotropic), Verdict::fails), (Labels{"(2.23)", "(2.23 op)"}));

    const auto constants =
        find_constants(literal.scene, pieces_of(literal.scene, literal.mesh), literal.mesh, literal.space);
    const auto compliance = std::ranges::find(conditions, "(2.23)", &Condition::label);
    ASSERT_EQ(compliance->numbers.size(), 2U);
    EXPECT_NEAR(compliance->numbers[0].value, 2 / 1.1, 1e-12);  // E/(1 + nu), the smaller eigenvalue
    EXPECT_NEAR(compliance->numbers[1].value, 12000 * *constants.s1 * *constants.s1, 1e-6);
}

/// The part of a mesh file (scene_files.h): one triangle right of the diagonal, one left of it.
const std::string two_regions = R"(
mesh.file = "part.msh"
time = {end = 1.0, steps = 4}
material = {density = 3.0, elasticity = {young = 2.0, poisson = 0.1}, viscosity = {trace = 10.0, shear = 10.0}}
heat = {capacity = 1.0, conductivity = 1.0, thermal_stress = 1.0, source = 1.0}
boundary.top.displacement = [0.0, 0.0]
boundary.top.temperature = 0.0
boundary.bottom.contact.compliance = {stiffness = 0.05}
boundary.bottom.contact.conductance = {coefficient = 0.5, onset = 1e-3, foundation_temperature = 1.0}
region.right.material = {density = 2.0, elasticity = {young = 1.0, poisson = 0.0}}
region.right.heat = {capacity = 2.0, conductivity = 0.25, thermal_stress = [[3.0, 0.0], [0.0, 4.0]], source = 7.0}
)";

const Number& number(const std::vector<Condition>& conditions, const std::string& label) {
    return std::ranges::find(conditions, label, &Condition::label)->numbers.at(0);
}

/// Each bound is that of the worst region, which is named; an override of every region hides the defaults.
TEST(Hypotheses, OfTwoRegions) {
    const auto conditions = judged(Discretisation(two_regions));
    const auto expect = [&](const std::string& label, double value, const std::string& where) {
        EXPECT_NEAR(number(conditions, label).value, value, 1e-14 * value) << label;
        EXPECT_EQ(number(conditions, label).where, where) << label;
    };
    expect("(2.3)", 2.0, " in right");
    expect("(2.4)", 1.0, " in left");
    expect("(H1 i)", 10.0, "");
    expect("(H2 i)", 1.0, " in right");
    expect("(H2 ii)", 2 / 0.9, " in left");
    expect("(H3 ii)", 0.25, " in right");
    expect("(H3 iii)", 1.0, " in left");
    expect("(H4 i)", 5.0, " in right");
    const auto covered_everywhere =
        judged(Discretisation(two_regions, {"region.left.material.density=4.0", "material.density=0.1"}));
    EXPECT_EQ(number(covered_everywhere, "(2.3)").value, 2.0);
}

TEST(Samples, HeatSourceOfEachRegion) {
    const Discretisation at(two_regions, {"region.right.heat.source=\"7 + 10*(y > 0.5 && x < 0.5)\""});
    const Samples samples = take_samples(at.scene, pieces_of(at.scene, at.mesh), at.mesh, at.space);
    EXPECT_EQ(samples.heat_source.smallest, 1);
    EXPECT_EQ(samples.heat_source.largest, 7);  // the upper left corner is not of the region right
}

/// Expressions are sampled in time as well as in space.
TEST(Samples, RangesOverNodesAndTimes) {
    const Discretisation at(covered, {"boundary.bottom.contact.gap=\"0.1 - 0.02*x*t\"", "time.steps=1000"});
    const Samples samples = take_samples(at.scene, pieces_of(at.scene, at.mesh), at.mesh, at.space);
    EXPECT_EQ(samples.times, 101);
    EXPECT_DOUBLE_EQ(samples.gap.smallest, 0.08);
    EXPECT_DOUBLE_EQ(samples.gap.largest, 0.1);
    EXPECT_DOUBLE_EQ(samples.foundation_temperature.largest, 10);
    EXPECT_DOUBLE_EQ(samples.traction.magnitude(), 1.4);
    EXPECT_FALSE(samples.heat_flux.present());
    EXPECT_EQ(samples.heat_flux.magnitude(), 0);
}

/// The conductance rises from zero to its coefficient over the onset.
TEST(LawBounds, OfLinearLaws) {
    const LawBounds bounds = bounds_of_laws(scene::read(covered));
    EXPECT_DOUBLE_EQ(bounds.L_nu, 0.05);
    EXPECT_DOUBLE_EQ(bounds.L_tau, 0.2 * 0.05);
    EXPECT_DOUBLE_EQ(bounds.M_kc, 0.5);
    EXPECT_DOUBLE_EQ(bounds.L_kc, 0.5 / 1e-3);
}

/// Isotropic tensors: 2 mu once for each deviatoric direction, 2 mu + d lambda for the volume.
TEST(TensorBounds, OfIsotropicTensors) {
    const double lambda = 3, mu = 0.7;
    const scene::VoigtTensor plane{{lambda + 2 * mu, lambda, 0, lambda, lambda + 2 * mu, 0, 0, 0, mu}, {}};
    EXPECT_NEAR(bounds_of(plane, 2).smallest, 2 * mu, 1e-14);
    EXPECT_NEAR(bounds_of(plane, 2).largest, 2 * mu + 2 * lambda, 1e-14);
    scene::VoigtTensor space{std::vector<double>(36, 0.0), {}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            space.matrix[6 * i + j] = lambda + (i == j ? 2 * mu : 0);
        }
        space.matrix[7 * (i + 3)] = mu;
    }
    EXPECT_NEAR(bounds_of(space, 3).smallest, 2 * mu, 1e-14);
    EXPECT_NEAR(bounds_of(space, 3).largest, 2 * mu + 3 * lambda, 1e-14);
    EXPECT_EQ(bounds_of(scene::SymmetricTensor{{1, 1, 1, 1}, 0}).smallest, 0);
    EXPECT_NEAR(norm_of({{0.3, 0.1, 0.1, 0.2}, 0}), std::sqrt(0.15), 1e-15);
}

}  // namespace
}  // namespace thermocontact::theory

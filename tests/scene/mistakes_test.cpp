// Every kind of mistake in a scene file, with the message it provokes.

#include "scene_files.h"

namespace thermocontact::scene {
namespace {

struct Mistake {
    const char* name;
    int line;             ///< of `base`, to be replaced
    const char* text;     ///< by this
    const char* message;  ///< all of it
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreNamed) {
    EXPECT_EQ(message(with_line(GetParam().line, GetParam().text)), GetParam().message);
}

const Mistake unknown_keys[] = {
    {"Typo", 20, "coefficent = 0.2",
     R"(scene.toml:20: boundary.bottom.contact.friction.coefficent: unknown key; did you mean "coefficient"?)"},
    {"Table", 6, "[materail]", R"(scene.toml:6: materail: unknown key; did you mean "material"?)"},
    {"OfAnotherTable", 2, "cells = [4, 4]\nsteps = 3",
     R"(scene.toml:3: mesh.steps: unknown key; did you mean "time.steps"?)"},
    {"OneLevelTooHigh", 15, "displacement = [0, 0]\n[boundary.left.contact]\nstiffness = 1",
     R"(scene.toml:17: boundary.left.contact.stiffness: unknown key; )"
     R"(did you mean "boundary.left.spring.stiffness" or "boundary.left.contact.compliance.stiffness"?)"},
    {"OfSeveralTables", 2, "cells = [4, 4]\ncoefficient = 3",
     R"(scene.toml:3: mesh.coefficient: unknown key; did you mean )"
     R"("boundary.NAME.convection.coefficient", )"
     R"("boundary.NAME.contact.friction.coefficient" or "boundary.NAME.contact.conductance.coefficient"?)"},
    {"LikeNothing", 5, "steps = 4\nfoo = 1",
     R"(scene.toml:6: time.foo: unknown key; expected "end", "steps", "step", "scheme", "tolerance", "spectral_radius", "coupling" or "coupling_tolerance")"},
    {"RegionOfAShape", 1, "region.inner.material.density = 1\n[mesh]",
     "scene.toml:1: region.inner: unknown region of the rectangle; it has none"},
    {"RegionOfAFile", 2, "file = \"part.msh\"\n[region.lefd.material]\ndensity = 1",
     R"(scene.toml:3: region.lefd: unknown region of the mesh part.msh; expected "left" or "right"; did you mean )"
     R"("left"?)"},
    {"BoundaryOfAFile", 2, "file = \"part.msh\"\n[boundary.botom]\ntemperature = 0",
     R"(scene.toml:3: boundary.botom: unknown boundary of the mesh part.msh; expected "bottom", "left", "right" or )"
     R"("top"; did you mean "bottom"?)"},
    {"GradedSide", 3, "grading.lfet = 2\n[time]",
     R"(scene.toml:3: mesh.grading.lfet: unknown key; did you mean "left"?)"},
    {"GradedBesideAFile", 2, "file = \"part.msh\"\ngrading.left = 2",
     "scene.toml:3: mesh.grading.left: cannot stand beside mesh.file (line 2); give one of the two"},
    {"NoSuchFile", 2, "file = \"prat.msh\"", "scene.toml:2: mesh.file: prat.msh: no such file"},
    {"FileBesideCells", 2, "cells = [4, 4]\nfile = \"part.msh\"",
     "scene.toml:3: mesh.file: cannot stand beside mesh.cells (line 2); give one of the two"},
    {"Quoted", 1, "\"mesh.cells\" = [4, 4]\n[mesh]",
     R"(scene.toml:1: "mesh.cells": unknown key; keys consist of letters, digits, _ and -)"},
    {"Boundary", 14, "[boundary.topp]",
     R"(scene.toml:14: boundary.topp: unknown boundary of the rectangle; )"
     R"(expected "left", "right", "bottom" or "top"; did you mean "top"?)"},
    {"BoundaryOfABox", 14, "[boundary.front]",
     R"(scene.toml:14: boundary.front: unknown boundary of the rectangle; expected "left", "right", "bottom" or "top")"},
};

const Mistake wrong_values[] = {
    {"NegativeDensity", 7, "density = -1",
     "scene.toml:7: material.density: expected a number > 0 (kg/m^3), found -1"},
    {"StringForANumber", 7, "density = \"1\"",
     R"(scene.toml:7: material.density: expected a number > 0 (kg/m^3), found "1")"},
    {"BooleanForANumber", 7, "density = true",
     "scene.toml:7: material.density: expected a number > 0 (kg/m^3), found true"},
    {"DateForANumber", 7, "density = 1979-05-27",
     "scene.toml:7: material.density: expected a number > 0 (kg/m^3), found a table or a date"},
    {"Infinity", 7, "density = inf",
     "scene.toml:7: material.density: expected a number > 0 (kg/m^3), found inf"},
    {"NotANumber", 9, "young = nan",
     "scene.toml:9: material.elasticity.young: expected a number > 0 (Pa), found nan"},
    {"TableForANumber", 7, "density = {value = 1}",
     "scene.toml:7: material.density: expected a number > 0 (kg/m^3), found a table"},
    {"NumberForATable", 6, "[boundary]\nleft = 3\n[material]",
     "scene.toml:7: boundary.left: expected a table, found 3"},
    {"ArrayOfTables", 14, "[[boundary.top]]",
     "scene.toml:14: boundary.top: expected a table, found [a table or a date]"},
    {"PoissonTooLarge", 10, "poisson = 0.5",
     "scene.toml:10: material.elasticity.poisson: expected a number in (-1, 0.5), found 0.5"},
    {"PoissonTooSmall", 10, "poisson = -1",
     "scene.toml:10: material.elasticity.poisson: expected a number in (-1, 0.5), found -1"},
    {"NoTime", 4, "end = 0.0", "scene.toml:4: time.end: expected a number > 0 (s), found 0.0"},
    {"NegativeTime", 4, "end = -1", "scene.toml:4: time.end: expected a number > 0 (s), found -1"},
    {"NoSteps", 5, "steps = 0", "scene.toml:5: time.steps: expected an integer in [1, 1000000000], found 0"},
    {"FloatForAnInteger", 5, "steps = 4.0",
     "scene.toml:5: time.steps: expected an integer in [1, 1000000000], found 4.0"},
    {"HugeInteger", 5, "steps = 9223372036854775807",
     "scene.toml:5: time.steps: expected an integer in [1, 1000000000], found 9223372036854775807"},
    {"TooFewCells", 2, "cells = [4]",
     "scene.toml:2: mesh.cells: expected an array of 2 integers in [1, 100000000], found [4]"},
    {"TooManyCells", 2, "cells = [4, 4, 4]",
     "scene.toml:2: mesh.cells: expected an array of 2 integers in [1, 100000000], found [4, 4, 4]"},
    {"FloatCells", 2, "cells = [4.0, 4]",
     "scene.toml:2: mesh.cells: expected an array of 2 integers in [1, 100000000], found [4.0, 4]"},
    {"HugeMesh", 2, "cells = [20000, 20000]",
     "scene.toml:2: mesh.cells: expected at most 100000000 cells, found 400000000"},
    {"Shape", 2, "cells = [4, 4]\nshape = \"sphere\"",
     R"(scene.toml:3: mesh.shape: expected "rectangle" or "box", found "sphere")"},
    {"BoxInTheBase", 2, "cells = [4, 4]\nshape = \"box\"",
     "scene.toml:2: mesh.cells: expected an array of 3 integers in [1, 100000000], found [4, 4]"},
    {"Choice", 2, "cells = [4, 4]\ndiagonal = \"rihgt\"",
     R"(scene.toml:3: mesh.diagonal: expected "right", "left" or "crossed", found "rihgt"; did you mean "right"?)"},
    {"Corners", 2, "cells = [4, 4]\nlower = [0, 2]",
     "scene.toml:3: mesh.lower: expected to be below mesh.upper = [1.0, 1.0] in every component, found [0.0, "
     "2.0]"},
    {"UpperCorner", 2, "cells = [4, 4]\nupper = [0, 2]",
     "scene.toml:3: mesh.upper: expected to exceed mesh.lower = [0.0, 0.0] in every component, found [0.0, "
     "2.0]"},
    {"GradedBelowOne", 2, "cells = [4, 4]\ngrading.left = 0.5",
     "scene.toml:3: mesh.grading.left: expected a number >= 1, found 0.5"},
    {"GradedWithoutEnd", 2, "cells = [4, 4]\ngrading.left = inf",
     "scene.toml:3: mesh.grading.left: expected a number >= 1, found inf"},
    {"GradedTooThin", 2, "cells = [4, 4]\ngrading.top = 1e14",
     "scene.toml:3: mesh.grading.top: expected cells of at least 2.82843e-10 (m), the smallest has "
     "3.16128e-11 where the ratio is 1e+14"},
    {"GradedOfABox", 2, "cells = [4, 4]\ngrading.front = 2",
     R"(scene.toml:3: mesh.grading.front: the rectangle has no such side; expected "left", "right", "bottom" or "top")"},
    {"StepDoesNotDivide", 5, "step = 0.3",
     "scene.toml:5: time.step: expected a step that divides time.end = 1 into at most 1000000000 equal "
     "steps, "
     "found 0.3"},
    {"StepBeyondTheEnd", 5, "step = 2",
     "scene.toml:5: time.step: expected a step that divides time.end = 1 into at most 1000000000 equal "
     "steps, "
     "found 2.0"},
    {"Displacement", 15, "displacement = [0, \"fre\"]",
     R"(scene.toml:15: boundary.top.displacement: bad expression "fre": unknown name "fre" at character 1; )"
     R"(expected "x", "y", "t", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", )"
     R"("log10", "sqrt", "abs", "min", "max", "pi" or "e")"},
    {"TractionLength", 15, "traction = [0]",
     "scene.toml:15: boundary.top.traction: expected an array of 2 numbers or expressions in x, y, t (Pa), "
     "found [0]"},
    {"FreeTraction", 15, "traction = 0",
     "scene.toml:15: boundary.top.traction: expected an array of 2 numbers or expressions in x, y, t (Pa), "
     "found 0"},
    {"Expression", 16, "temperature = \"1 + sinn(x)\"",
     R"_(scene.toml:16: boundary.top.temperature: bad expression "1 + sinn(x)": )_"
     R"(unknown name "sinn" at character 5; did you mean "sin"?)"},
    {"ExpressionType", 16, "temperature = true",
     "scene.toml:16: boundary.top.temperature: expected a number or an expression in x, y, t (K), found "
     "true"},
    {"InfiniteExpression", 16, "temperature = inf",
     "scene.toml:16: boundary.top.temperature: expected a number or an expression in x, y, t (K), found inf"},
    {"Friction", 20, "coefficient = -0.1",
     "scene.toml:20: boundary.bottom.contact.friction.coefficient: expected a number >= 0, found -0.1"},
    {"Regularisation", 21, "regularisation = -1",
     "scene.toml:21: boundary.bottom.contact.friction.regularisation: expected a number >= 0 (m/s), found "
     "-1"},
    {"QuadratureOfExactFriction", 21, "regularisation = 0\n[boundary.bottom.contact]\nquadrature = 3",
     "scene.toml:23: boundary.bottom.contact.quadrature: expected 1, 2, 4 or \"vertex\" where "
     "friction.regularisation = 0, found 3"},
    {"Exponent", 18, "stiffness = 1\nexponent = 0.5",
     "scene.toml:19: boundary.bottom.contact.compliance.exponent: expected a number >= 1, found 0.5"},
    {"Quadrature", 17, "[boundary.bottom.contact]\nquadrature = 10\n[boundary.bottom.contact.compliance]",
     R"(scene.toml:18: boundary.bottom.contact.quadrature: expected an integer in [1, 9] or "vertex", found 10)"},
    {"FieldTwice", 1, "output.fields = [\"stress\", \"stress\"]\n[mesh]",
     R"(scene.toml:1: output.fields: expected a list of names, each once, among "displacement", "velocity", )"
     R"("temperature", "stress", "von_mises" or "contact", found ["stress", "stress"])"},
    {"Tolerance", 1, "solver.tolerance = 0.1\n[mesh]",
     "scene.toml:1: solver.tolerance: expected a number in (0, 0.01], found 0.1"},
};

const Mistake tensors[] = {
    {"NotSymmetric", 13, "conductivity = [[1, 2], [0, 1]]",
     "scene.toml:13: heat.conductivity: expected a number > 0 or a symmetric positive semidefinite 2 x 2 "
     "matrix "
     "(W/(m K)), found [[1, 2], [0, 1]] (not symmetric)"},
    {"Indefinite", 13, "conductivity = [[1, 2], [2, 1]]",
     "scene.toml:13: heat.conductivity: expected a number > 0 or a symmetric positive semidefinite 2 x 2 "
     "matrix "
     "(W/(m K)), found [[1, 2], [2, 1]] (smallest eigenvalue -1)"},
    {"NoConductivity", 13, "conductivity = 0",
     "scene.toml:13: heat.conductivity: expected a number > 0 or a symmetric positive semidefinite 2 x 2 "
     "matrix "
     "(W/(m K)), found 0"},
    {"NotSquare", 13, "conductivity = [[1, 2], [2]]",
     "scene.toml:13: heat.conductivity: expected a number > 0 or a symmetric positive semidefinite 2 x 2 "
     "matrix "
     "(W/(m K)), found [[1, 2], [2]]"},
    {"Coupling", 13, "conductivity = 1\nthermal_stress = [[1, 2], [0, 1]]",
     "scene.toml:14: heat.thermal_stress: expected a number or a symmetric 2 x 2 matrix (Pa/K), "
     "found [[1, 2], [0, 1]] (not symmetric)"},
    {"Voigt", 10, "poisson = 0.1\n[material.viscosity]\ntensor = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
     "scene.toml:12: material.viscosity.tensor: expected a symmetric positive semidefinite 3 x 3 matrix (Pa "
     "s), "
     "found [[1, 0, 0], [0, 1, 0], [0, 0, -1]] (smallest eigenvalue -1)"},
    {"VoigtSize", 10, "poisson = 0.1\n[material.viscosity]\ntensor = [[1, 0], [0, 1]]",
     "scene.toml:12: material.viscosity.tensor: expected a symmetric positive semidefinite 3 x 3 matrix (Pa "
     "s), "
     "found [[1, 0], [0, 1]]"},
    {"NegativeViscosity", 10, "poisson = 0.1\n[material.viscosity]\ntrace = -1.5\nshear = 2",
     "scene.toml:12: material.viscosity.trace: expected a number >= -shear/2 = -1 (Pa s) so that viscosity "
     "never "
     "produces energy, found -1.5"},
};

const Mistake combinations[] = {
    {"AdaptiveMidpoint", 5, "steps = 4\nscheme = \"midpoint\"\ntolerance = 1e-3",
     R"(scene.toml:7: time.tolerance: needs a time.scheme that damps: "backward-euler", "bdf2" or )"
     R"("generalized-alpha"; under "midpoint" fast motions ring on and their rates say nothing of the error)"},
    {"StepAndSteps", 5, "steps = 4\nstep = 0.25",
     "scene.toml:6: time.step: cannot stand beside time.steps (line 5); give one of the two"},
    {"NeitherStepNorSteps", 5, "",
     "scene.toml:3: time.steps: missing; add steps = 20, or step = 0.125 to [time]"},
    {"NoCells", 2, "",
     "scene.toml:1: mesh.cells: missing; add cells = [8, 4], or file = \"part.msh\" to [mesh]"},
    {"NoYoung", 9, "",
     "scene.toml:8: material.elasticity.young: missing; add young = 2.1e11, or "
     "tensor = [[3.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0, 0.0, 1.0]] to [material.elasticity]"},
    {"NoRegularisation", 21, "",
     "scene.toml:19: boundary.bottom.contact.friction.regularisation: missing; add regularisation = 1e-4 to "
     "[boundary.bottom.contact.friction]"},
    {"TensorAndYoung", 10, "poisson = 0.1\ntensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
     "scene.toml:11: material.elasticity.tensor: cannot stand beside material.elasticity.young (line 9); "
     "give one of the two"},
    {"TemperatureAndHeatFlux", 16, "heat_flux = 0\ntemperature = 0",
     "scene.toml:17: boundary.top.temperature: cannot stand beside boundary.top.heat_flux (line 16); "
     "give one of the two"},
    {"TemperatureAndConductance", 17,
     "[boundary.bottom]\ntemperature = 1\n[boundary.bottom.contact.compliance]",
     "scene.toml:24: boundary.bottom.contact.conductance: cannot stand beside boundary.bottom.temperature "
     "(line 18); "
     "give one of the two"},
    {"TractionAgainstDisplacement", 15, "traction = [0, 1]\ndisplacement = [\"free\", 0]",
     "scene.toml:16: boundary.top.displacement: conflicts with boundary.top.traction (line 15): "
     "the y component is both prescribed and loaded; make it \"free\" or 0"},
    {"PrescribedSpring", 15, "displacement = [0, 0]\nspring.stiffness = 4",
     "scene.toml:16: boundary.top.spring: conflicts with boundary.top.displacement (line 15): "
     "every displacement component is prescribed; make one \"free\""},
    {"PrescribedContact", 17,
     "[boundary.bottom]\ndisplacement = [0, 0]\n[boundary.bottom.contact.compliance]",
     "scene.toml:19: boundary.bottom.contact.compliance: conflicts with boundary.bottom.displacement (line "
     "18): "
     "every displacement component is prescribed; make one \"free\""},
    {"FrictionWithoutCompliance", 14,
     "[boundary.left.contact.friction]\ncoefficient = 1\nregularisation = 1\n"
     "[boundary.top]",
     "scene.toml:15: boundary.left.contact.friction.coefficient: needs boundary.left.contact.compliance, "
     "which the scene lacks"},
    {"ContactWithoutALaw", 14, "[boundary.left.contact]\ngap = 1\n[boundary.top]",
     "scene.toml:14: boundary.left.contact: needs [boundary.left.contact.compliance] or "
     "[boundary.left.contact.conductance]"},
};

TEST(MistakesInSpace, KeysOfThePlane) {
    const std::string box = "[mesh]\nshape = \"box\"\ncells = [2, 2, 2]\n",
                      physics =
                          "[time]\nend = 1\nsteps = 1\n[material.elasticity]\nyoung = 2\npoisson = 0.1\n";
    EXPECT_EQ(message(box + "diagonal = \"left\"\n" + physics),
              "scene.toml:4: mesh.diagonal: the body has three dimensions; leave it out");
    EXPECT_EQ(message(box + physics + "plane = \"strain\"\n"),
              "scene.toml:10: material.elasticity.plane: the body has three dimensions; leave it out");
}

std::string name_of(const testing::TestParamInfo<Mistake>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(UnknownKey, Mistakes, testing::ValuesIn(unknown_keys), name_of);
INSTANTIATE_TEST_SUITE_P(WrongValue, Mistakes, testing::ValuesIn(wrong_values), name_of);
INSTANTIATE_TEST_SUITE_P(Tensor, Mistakes, testing::ValuesIn(tensors), name_of);
INSTANTIATE_TEST_SUITE_P(Combination, Mistakes, testing::ValuesIn(combinations), name_of);

}  // namespace
}  // namespace thermocontact::scene

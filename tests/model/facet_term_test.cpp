#include "model/facet_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/physics.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

constexpr double k = 0.1;             ///< time step, s
constexpr double stiffness = 400.0;   ///< c_n
constexpr double friction = 0.3;      ///< mu
constexpr double facet_length = 0.5;  ///< of the bottom's two facets, m

std::string contact_scene(double exponent, double regularisation) {
    return "mesh.cells = [2, 1]\ntime = {end = 0.1, steps = 1}\nmaterial.density = 1\n"
           "material.elasticity = {young = 1, poisson = 0.2}\n[boundary.bottom.contact]\n"
           "compliance = {stiffness = " +
           std::to_string(stiffness) + ", exponent = " + std::to_string(exponent) + "}\n" +
           "friction = {coefficient = " + std::to_string(friction) +
           ", regularisation = " + std::to_string(regularisation * 1e9) + "e-9}\n";
}

enum class Closure { open, touching, closed };

struct Case {
    double regularisation;
    double exponent;
    double penetration;  ///< r, m; 0: touching, with the slip alone not at rest
    double slip;         ///< |w_t| / regularisation

    Closure closure() const {
        return penetration < 0 ? Closure::open : penetration == 0 ? Closure::touching : Closure::closed;
    }
};

std::vector<Case> cases() {
    std::vector<Case> result;
    for (int decade = -8; decade <= -1; ++decade) {
        for (const double exponent : {1.0, 2.0}) {
            for (const double penetration : {-1e-3, -1e-6, -1e-10, 0.0, 1e-10, 1e-6, 1e-3, 0.1}) {
                for (const double slip : {0.0, 0.3, 1.0, 30.0}) {
                    result.push_back({std::pow(10.0, decade), exponent, penetration, slip});
                }
            }
        }
    }
    return result;
}

/// Compliance and friction on the bottom, all of which moves alike: penetration r, slip along x.
class Bottom {
  public:
    Bottom(const Case& state)
        : at_(contact_scene(state.exponent, state.regularisation)), term_(at_.space, 2, velocity_) {
        // the outward normal is -y: u_n = -u_y. No motion along it, so that r is that of u_old alone.
        old_displacement_ = at_.nodal([&](double, double) {
            return std::array<double, 2>{0.0, -state.penetration};
        });
        velocity_ = at_.nodal([&](double, double) {
            return std::array<double, 2>{state.slip * state.regularisation, 0.0};
        });
        const ContactSurface& surface = *at_.surfaces.front();
        const fem::Fields fields{{"w", {&velocity_, 2, &at_.space.dofmap}},
                                 {"u_old", {&old_displacement_, 2, &at_.space.dofmap}},
                                 {"g", {&surface.gap, 1, &at_.space.dofmap}}};
        for (const char* law : {"compliance", "friction"}) {
            term_.add(law, at_.mesh, surface, contact_constants(surface.laws, k), fields);
        }
        std::vector<std::int32_t> dofs;
        for (const std::int32_t node : surface.nodes) {
            dofs.insert(dofs.end(), {2 * node, 2 * node + 1});
        }
        term_.restrict_to(dofs);
        x_.resize(static_cast<Eigen::Index>(dofs.size()));
        for (std::size_t i = 0; i < dofs.size(); ++i) {
            x_[static_cast<Eigen::Index>(i)] = velocity_[dofs[i]];
        }
    }
    Bottom(const Bottom&) = delete;
    Bottom& operator=(const Bottom&) = delete;

    const Eigen::VectorXd& x() const { return x_; }
    FacetTerm& term() { return term_; }
    std::size_t dof_count() const { return velocity_.size(); }
    Eigen::VectorXd value(const Eigen::VectorXd& x) {
        Eigen::VectorXd result;
        term_.evaluate(x, result);
        return result;
    }
    Eigen::MatrixXd derivative() {
        Eigen::MatrixXd result = Eigen::MatrixXd::Zero(x_.size(), x_.size());
        term_.add_derivative(x_, result);
        return result;
    }
    Eigen::VectorXd shifted(Eigen::Index i, double step) const {
        Eigen::VectorXd result = x_;
        result[i] += step;
        return result;
    }

  private:
    support::Discretisation at_;
    std::vector<double> velocity_, old_displacement_;
    FacetTerm term_;
    Eigen::VectorXd x_;
};

/// A central difference with step h errs by h^2/6 max|F'''| (truncation) and by noise(F)/h (round-off).
/// Noise: F is a sum of products of p_n(r), r being good to a few epsilon |r| and w_t to a few epsilon |w_t|.
struct Difference {
    double step;
    double tolerance;
};

/// Along x only the friction's direction w_t/|w_t|_eps varies: its third derivative is at most 3/eps^3, its
/// first 1/eps. h = eps * machine epsilon^(1/3) balances the two errors.
Difference tangential(const Case& state) {
    const double machine = std::numeric_limits<double>::epsilon();
    const double p = stiffness * std::pow(std::max(state.penetration, 0.0), state.exponent);
    const double step = state.regularisation * std::cbrt(machine);
    const double force = friction * p * 2 * facet_length;
    const double truncation = step * step / 6 * 3 * force / std::pow(state.regularisation, 3);
    const double noise = 16 * machine * force * (1 + state.slip) / step;
    return {step, truncation + noise};
}

/// Along y only p_n varies, a polynomial of degree 1 or 2 as long as r keeps its sign: no truncation error.
/// The step moves r by a thousandth.
Difference normal(const Case& state) {
    const double machine = std::numeric_limits<double>::epsilon();
    const double r = std::abs(state.penetration);
    const double step = 1e-3 * r / k;
    const double force = (1 + friction) * stiffness * std::pow(r, state.exponent) * 2 * facet_length;
    return {step, state.closure() == Closure::open ? 0.0 : 16 * machine * force / step};
}

/// At r = 0 the derivative is that of closing: a difference to that side (-y), r from 0 to k h. For exponent
/// 1 exact up to round-off, for exponent 2 the truncation error is h/2 F'' = h c_n k^2 times the shape
/// functions' products.
Difference closing(const Case& state) {
    const double step = 1e-6;
    const double force = (1 + friction) * stiffness * std::pow(k * step, state.exponent) * 2 * facet_length;
    const double noise = 16 * std::numeric_limits<double>::epsilon() * force / step;
    return {step, state.exponent == 1 ? noise : force / step};
}

TEST(FacetTerm, DerivativeEqualsDifferences) {
    for (const Case& state : cases()) {
        SCOPED_TRACE("epsilon " + std::to_string(std::log10(state.regularisation)) + " exponent " +
                     std::to_string(state.exponent) + " r " + std::to_string(1e10 * state.penetration) +
                     "e-10 slip " + std::to_string(state.slip));
        Bottom bottom(state);
        const Eigen::MatrixXd derivative = bottom.derivative();
        for (Eigen::Index i = 0; i < bottom.x().size(); ++i) {
            const bool along = i % 2 == 0, one_sided = !along && state.closure() == Closure::touching;
            const Difference by = along ? tangential(state) : one_sided ? closing(state) : normal(state);
            const double up = one_sided ? 0.0 : by.step;
            const Eigen::VectorXd difference =
                (bottom.value(bottom.shifted(i, up)) - bottom.value(bottom.shifted(i, -by.step))) /
                (up + by.step);
            ASSERT_LE((difference - derivative.col(i)).cwiseAbs().maxCoeff(), by.tolerance) << "column " << i;
        }
    }
}

/// Contact that just touches counts as closed: derivative c_n k (phi_i n, phi_j n), with int phi_0^2 = length
/// / 3.
TEST(FacetTerm, TouchingIsClosed) {
    Bottom bottom({1e-3, 1.0, 0.0, 0.0});
    const Eigen::MatrixXd derivative = bottom.derivative();
    EXPECT_DOUBLE_EQ(derivative(1, 1), stiffness * k * facet_length / 3);
    EXPECT_EQ(bottom.value(bottom.x()).cwiseAbs().maxCoeff(), 0.0);
}

TEST(FacetTerm, OpenContactIsNothing) {
    Bottom bottom({1e-3, 1.0, -1e-12, 1.0});
    EXPECT_EQ(bottom.value(bottom.x()).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(bottom.derivative().cwiseAbs().maxCoeff(), 0.0);
}

/// Resultants of uniform states: -p_n n |bottom| and mu p_n w_t/|w_t|_eps |bottom|.
TEST(FacetTerm, ForcesAddUp) {
    const double r = 1e-3, eps = 1e-2, slip = 2.0;
    Bottom bottom({eps, 1.0, r, slip});
    const Eigen::VectorXd value = bottom.value(bottom.x());
    double x = 0, y = 0;
    for (Eigen::Index i = 0; i < value.size(); i += 2) {
        x += value[i];
        y += value[i + 1];
    }
    const double p = stiffness * r;
    EXPECT_NEAR(y, -p, 1e-14);  // n = -y
    EXPECT_NEAR(x, friction * p * slip / std::sqrt(slip * slip + 1), 1e-14);
}

/// Compliance takes u_old, which has no digits beyond its last: the forces change as much when all of it
/// grows by a share. Friction's data do not count.
TEST(FacetTerm, SensitivityToTheDisplacement) {
    const double r = 1e-3, share = 1e-3;
    Bottom bottom({1e-2, 1.0, r, 2.0}), larger({1e-2, 1.0, r * (1 + share), 2.0});
    Eigen::VectorXd noise = Eigen::VectorXd::Constant(bottom.x().size(), 1.0);
    bottom.term().set_step(k);
    bottom.term().add_sensitivity(bottom.x(), noise);
    const Eigen::VectorXd change = (larger.value(bottom.x()) - bottom.value(bottom.x())).cwiseAbs() / share;
    for (Eigen::Index i = 0; i < noise.size(); i += 2) {
        EXPECT_EQ(noise[i], 1.0);
        EXPECT_NEAR(noise[i + 1] - 1, change[i + 1], 1e-12);
        EXPECT_GT(change[i + 1], 0);
    }
}

/// Conductance is regularised by its limit, and takes theta_F.
TEST(FacetTerm, OfConductance) {
    support::Discretisation at(
        "mesh.cells = [2, 1]\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n[boundary.bottom.contact]\ngap "
        "= "
        "-1\nconductance = {coefficient = 4, onset = 0.1, foundation_temperature = -50, limit = 2}\n");
    const ContactSurface& surface = *at.surfaces.front();
    std::vector<double> theta(at.node_count(), 0.0), u(2 * at.node_count(), 0.0);
    FacetTerm term(at.space, 1, theta);
    term.add("conductance", at.mesh, surface, contact_constants(surface.laws, 0.0),
             {{"theta", {&theta, 1, &at.space.dofmap}},
              {"theta_F", {&surface.foundation_temperature, 1, &at.space.dofmap}},
              {"u", {&u, 2, &at.space.dofmap}},
              {"g", {&surface.gap, 1, &at.space.dofmap}}});
    term.restrict_to(surface.nodes);
    EXPECT_FALSE(term.has_friction());
    EXPECT_EQ(term.smallest_regularisation(), 2.0);
    EXPECT_EQ(term.largest_foundation(), 50.0);
    const Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
    Eigen::VectorXd flow, noise = x;
    term.evaluate(x, flow);
    EXPECT_NEAR(flow.sum(), 4 * 2, 1e-13);
    term.add_sensitivity(x, noise);
    EXPECT_EQ(noise.sum(), 0) << "beyond the limit theta_F does not matter";
    term.raise_regularisation(100);
    term.evaluate(x, flow);
    EXPECT_NEAR(flow.sum(), 4 * 50, 1e-12);
    term.add_sensitivity(x, noise);
    EXPECT_NEAR(noise.sum(), 4 * 50, 1e-12);
}

/// The ladder of continuation raises epsilon, and 0 gives the scene's own back.
TEST(FacetTerm, RegularisationIsRaisedAndRestored) {
    const double r = 1e-3, eps = 1e-8, slip = 1e4;
    Bottom bottom({eps, 1.0, r, slip});
    const Eigen::VectorXd own = bottom.value(bottom.x());
    EXPECT_EQ(bottom.term().smallest_regularisation(), eps);
    bottom.term().raise_regularisation(1e-4);  // = |w_t|: the friction falls to 1/sqrt(2)
    EXPECT_NEAR(bottom.value(bottom.x())[0] / own[0], 1 / std::sqrt(2.0), 1e-7);
    EXPECT_EQ(bottom.value(bottom.x())[1], own[1]);
    bottom.term().raise_regularisation(1e-9);  // below the scene's: no effect
    EXPECT_EQ(bottom.value(bottom.x()), own);
    bottom.term().raise_regularisation(0);
    EXPECT_EQ(bottom.value(bottom.x()), own);
}

/// Of several surfaces the smallest, in whatever order they come; frictionless ones have none.
TEST(FacetTerm, SmallestRegularisationOfAllSurfaces) {
    const auto contact = [](const std::string& side, const std::string& law) {
        return "[boundary." + side + ".contact]\ncompliance = {stiffness = 1}\n" +
               (law.empty() ? "" : "friction = {coefficient = 0.1, regularisation = " + law + "}\n");
    };
    const std::string body =
        "mesh.cells = [1, 1]\ntime = {end = 1, steps = 1}\n"
        "material.viscosity = {trace = 1, shear = 1}\n";
    const auto smallest = [&](const std::string& text) {
        support::Discretisation at(body + text);
        std::vector<double> u(2 * at.node_count(), 0.0), w = u;
        FacetTerm term(at.space, 2, w);
        for (const auto& surface : at.surfaces) {
            const fem::Fields fields{{"w", {&w, 2, &at.space.dofmap}},
                                     {"u_old", {&u, 2, &at.space.dofmap}},
                                     {"g", {&surface->gap, 1, &at.space.dofmap}}};
            term.add(surface->laws.friction ? "friction" : "compliance", at.mesh, *surface,
                     contact_constants(surface->laws, 1.0), fields);
        }
        return term.smallest_regularisation();
    };
    EXPECT_EQ(smallest(contact("bottom", "1e-3") + contact("top", "1e-6") + contact("left", "")), 1e-6);
    EXPECT_EQ(smallest(contact("bottom", "1e-6") + contact("top", "1e-3")), 1e-6);
    EXPECT_EQ(smallest(contact("bottom", "")), 0.0);
}

/// nodal_forces() tells the laws apart and together they are the value.
TEST(FacetTerm, NodalForcesOfEachLaw) {
    Bottom bottom({1e-3, 1.0, 1e-3, 1.0});
    const Eigen::VectorXd value = bottom.value(bottom.x());
    std::vector<double> compliance(bottom.dof_count(), 0.0), sliding = compliance;
    bottom.term().nodal_forces("compliance", compliance);
    bottom.term().nodal_forces("friction", sliding);
    for (Eigen::Index i = 0; i < value.size(); ++i) {  // bottom's three nodes are the mesh's first
        EXPECT_EQ((i % 2 == 0 ? compliance : sliding)[i], 0.0);
        EXPECT_DOUBLE_EQ(compliance[i] + sliding[i], value[i]);
    }
    for (auto i = static_cast<std::size_t>(value.size()); i < compliance.size(); ++i) {
        EXPECT_EQ(compliance[i] + sliding[i], 0.0);
    }
}

/// Unknowns that are prescribed have no row and no column.
TEST(FacetTerm, RestrictedToSomeDofs) {
    Bottom bottom({1e-3, 1.0, 1e-3, 1.0});
    const Eigen::MatrixXd all = bottom.derivative();
    bottom.term().restrict_to({5, 2});  // y of the third node, x of the second
    Eigen::MatrixXd some = Eigen::MatrixXd::Ones(2, 2);
    bottom.term().add_derivative(Eigen::Vector2d(bottom.x()[5], bottom.x()[2]), some);
    EXPECT_DOUBLE_EQ(some(0, 0), 1 + all(5, 5));
    EXPECT_DOUBLE_EQ(some(0, 1), 1 + all(5, 2));
    EXPECT_DOUBLE_EQ(some(1, 0), 1 + all(2, 5));
    EXPECT_DOUBLE_EQ(some(1, 1), 1 + all(2, 2));
}

/// The heat's contact term: conductance on its slope and in full, the limit not reached, reached from both
/// sides.
TEST(FacetTerm, ConductanceDerivativeEqualsDifferences) {
    struct HeatCase {
        double penetration, temperature, expected_slope;  ///< d(k_c phi_L)/d theta
    };
    const double k_c = 3, onset = 1e-3, limit = 5;
    for (const HeatCase& state : {HeatCase{-1e-4, 1, 0}, HeatCase{0, 1, 0}, HeatCase{0.5e-3, 1, 1.5},
                                  HeatCase{2e-3, 1, 3}, HeatCase{2e-3, 4.999, 3}, HeatCase{2e-3, 5.001, 0},
                                  HeatCase{2e-3, -4.999, 3}, HeatCase{2e-3, -5.001, 0}}) {
        support::Discretisation at(
            "mesh.cells = [2, 1]\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n"
            "boundary.bottom.contact.conductance = {coefficient = 3, onset = 1e-3, foundation_temperature = "
            "0, limit = 5}\n");
        std::vector<double> theta(at.node_count(), state.temperature);
        const auto u = at.nodal([&](double, double) {
            return std::array<double, 2>{0.0, -state.penetration};
        });
        const ContactSurface& surface = *at.surfaces.front();
        FacetTerm term(at.space, 1, theta);
        term.add("conductance", at.mesh, surface, contact_constants(surface.laws, 0.0),
                 {{"theta", {&theta, 1, &at.space.dofmap}},
                  {"theta_F", {&surface.foundation_temperature, 1, &at.space.dofmap}},
                  {"u", {&u, 2, &at.space.dofmap}},
                  {"g", {&surface.gap, 1, &at.space.dofmap}}});
        term.restrict_to({0, 1, 2});
        Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(3, 3);
        term.add_derivative(Eigen::Vector3d::Constant(state.temperature), derivative);
        EXPECT_NEAR(derivative.sum(), state.expected_slope, 1e-14);
        Eigen::VectorXd value;
        term.evaluate(Eigen::Vector3d::Constant(state.temperature), value);
        const double transfer = k_c * std::clamp(state.penetration / onset, 0.0, 1.0);
        EXPECT_NEAR(value.sum(), transfer * std::clamp(state.temperature, -limit, limit), 1e-13);
        for (Eigen::Index i = 0; i < 3; ++i) {  // piecewise linear: differences are exact up to round-off / h
            const double h = 1e-4;
            Eigen::VectorXd up, down, x = Eigen::Vector3d::Constant(state.temperature);
            x[i] += h;
            term.evaluate(x, up);
            x[i] -= 2 * h;
            term.evaluate(x, down);
            EXPECT_LE(((up - down) / (2 * h) - derivative.col(i)).cwiseAbs().maxCoeff(), 1e-15 * 15 / h);
        }
    }
}

}  // namespace
}  // namespace thermocontact::model

// What a balance makes of the ends that a strategy reports.

#include "march/balance.h"

#include <gtest/gtest.h>

#include "model/physics.h"
#include "parallel/backend.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

using solve::NewtonEnd;
using solve::NewtonResult;

/// Reports what stands in a list, one entry a solve; the fastest unknown is as slow as the regularisation, so
/// that continuation has one rung.
class Scripted : public solve::StepProblem {
  public:
    explicit Scripted(std::vector<NewtonResult>& ends) : ends_(&ends) {}

    const std::vector<std::int32_t>& contact_dofs() const override { return none_; }
    Eigen::VectorXd begin(const std::vector<double>&, const std::vector<double>&) override {
        return Eigen::VectorXd::Zero(1);
    }
    NewtonResult solve(solve::NonlinearTerm&, Eigen::VectorXd&) override {
        const NewtonResult next = ends_->front();
        ends_->erase(ends_->begin());
        return next;
    }
    void evaluate_at(const Eigen::VectorXd&, solve::NonlinearTerm&) override {}
    double largest_unknown(const Eigen::VectorXd&) override { return 1e-3; }
    bool finish(const Eigen::VectorXd&, std::vector<double>&) override { return true; }

  private:
    std::vector<NewtonResult>* ends_;
    std::vector<std::int32_t> none_;
};

class ScriptedStrategy : public solve::Strategy {
  public:
    std::vector<NewtonResult> ends;

    std::string name() const override { return "scripted"; }
    const parallel::Team& team() const override { return parallel::team_of(nullptr); }
    std::unique_ptr<solve::StepProblem> prepare(const solve::StepProblemInput&) override {
        return std::make_unique<Scripted>(ends);
    }
};

class BalanceReports : public testing::Test {
  protected:
    support::Discretisation at{
        "mesh.cells = [2, 2]\ntime = {end = 1, steps = 1}\nmaterial.viscosity = {trace = 1, shear = 1}\n"
        "[boundary.bottom.contact]\ncompliance.stiffness = 1\n"
        "friction = {coefficient = 0.5, regularisation = 1e-3}\n"};
    std::vector<double> velocity = std::vector<double>(2 * at.node_count(), 0.0), displacement = velocity,
                        rhs = velocity;
    ScriptedStrategy strategy;

    model::FacetTerm contact() {
        model::FacetTerm term(at.space, 2, velocity);
        for (const auto& surface : at.surfaces) {
            term.add("friction", at.mesh, *surface, model::contact_constants(surface->laws, 0.0),
                     {{"w", {&velocity, 2, &at.space.dofmap}},
                      {"u_old", {&displacement, 2, &at.space.dofmap}},
                      {"g", {&surface->gap, 1, &at.space.dofmap}}});
        }
        return term;
    }

    SolveReport report(std::vector<NewtonResult> ends) {
        strategy.ends = std::move(ends);
        Balance balance(
            "momentum", at.scene.solver, [&](double) { return fem::zero_matrix(at.graph, 2, 2); },
            model::Prescribed::displacement(at.scene, at.mesh, at.space),
            model::nodes_with(at.surfaces, at.space, &scene::Contact::compliance), contact(), at.space,
            strategy, velocity);
        balance.use(1.0);
        return balance.solve(rhs);
    }
};

TEST_F(BalanceReports, IterationsOfOneAttempt) {
    const SolveReport of_one = report({{NewtonEnd::converged, 4, 1e-13}});
    EXPECT_EQ(of_one.iterations, 4);
    EXPECT_EQ(of_one.retries, 0);
}

/// What the attempt without continuation has cost counts as well.
TEST_F(BalanceReports, IterationsOfAllAttempts) {
    const SolveReport of_two =
        report({{NewtonEnd::too_many_iterations, 50, 1e-3}, {NewtonEnd::converged, 7, 1e-13}});
    EXPECT_EQ(of_two.iterations, 57);
    EXPECT_EQ(of_two.retries, 1);
    EXPECT_TRUE(strategy.ends.empty());
}

TEST_F(BalanceReports, AStepFailsWhereContinuationDoes) {
    EXPECT_THROW(report(std::vector<NewtonResult>(200, {NewtonEnd::line_search_failed, 1, 1e-3})),
                 StepFailure);
}

}  // namespace
}  // namespace thermocontact::march

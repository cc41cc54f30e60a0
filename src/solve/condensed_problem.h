/// Strategy "condensed" (MODEL.md, 5): one Cholesky factor with the contact unknowns last, dense Newton on
/// them.
#pragma once

#include "solve/condensed_system.h"
#include "solve/step_problem.h"

namespace thermocontact::solve {

class CondensedProblem : public StepProblem {
  public:
    CondensedProblem(const StepProblemInput& input, std::span<const std::int32_t> interior,
                     std::shared_ptr<Workers> workers)
        : matrix_(&input.matrix),
          system_(input.matrix, input.fixed, input.contact_nodes, interior, std::move(workers)),
          newton_(input.newton) {}

    const std::vector<std::int32_t>& contact_dofs() const override { return system_.contact_dofs(); }
    Eigen::VectorXd begin(const std::vector<double>& rhs, const std::vector<double>& start) override;
    NewtonResult solve(NonlinearTerm& F, Eigen::VectorXd& x) override;
    void evaluate_at(const Eigen::VectorXd& x, NonlinearTerm& F) override;
    double largest_unknown(const Eigen::VectorXd& start) override;
    bool finish(const Eigen::VectorXd& x, std::vector<double>& solution) override;
    std::optional<KeptDerivative> kept_derivative() const override {
        return newton_.kept_derivative(system_.schur_complement());
    }
    void take_up(const KeptDerivative& derivative) override {
        newton_.take_up(system_.schur_complement(), derivative);
    }
    std::optional<Condition> condition(const std::vector<double>& solution) override;
    std::int64_t factor_entries() const override { return system_.factor_entries(); }

  private:
    Eigen::VectorXd solve_with_factors(const Eigen::VectorXd& rhs, bool transposed);

    const fem::BlockMatrix* matrix_;
    CondensedSystem system_;
    Newton newton_;
    Eigen::VectorXd rhs_;  ///< condensed
};

class Condensed : public Strategy {
  public:
    /// `orders` may hold orders that were computed before.
    explicit Condensed(InteriorOrders orders) : orders_(std::move(orders)) {}
    std::string name() const override { return "condensed"; }
    const parallel::Team& team() const override { return alone_; }
    std::unique_ptr<StepProblem> prepare(const StepProblemInput& input) override;

  private:
    parallel::Alone alone_;
    InteriorOrders orders_;
    std::shared_ptr<Workers> workers_ = std::make_shared<Workers>(Workers::available());
};

}  // namespace thermocontact::solve

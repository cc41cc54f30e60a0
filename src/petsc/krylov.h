/// Strategy "newton-krylov": Newton on the whole system, spread over the processes; CG or GMRES with
/// algebraic multigrid in single precision. The constant part A is assembled once, only contact facets are
/// revisited, and the hierarchy is used again for as long as its iterations stay near those of a new one.
#pragma once

#include <optional>

#include "multigrid/preconditioner.h"
#include "parallel/part.h"
#include "petsc/objects.h"
#include "petsc/shared_vectors.h"
#include "petsc/tangent.h"
#include "solve/step_problem.h"

namespace thermocontact::petsc {

class KrylovProblem final : public solve::StepProblem {
  public:
    KrylovProblem(const solve::StepProblemInput& input, const parallel::Part& part,
                  const parallel::Team& team);

    const std::vector<std::int32_t>& contact_dofs() const override { return contact_dofs_; }
    Eigen::VectorXd begin(const std::vector<double>& rhs, const std::vector<double>& start) override;
    solve::NewtonResult solve(solve::NonlinearTerm& F, Eigen::VectorXd& x) override;
    void evaluate_at(const Eigen::VectorXd& x, solve::NonlinearTerm& F) override;
    double largest_unknown(const Eigen::VectorXd& start) override;
    bool finish(const Eigen::VectorXd& x, std::vector<double>& solution) override;
    /// By solves with the last tangent (krylov_condition.cpp); nothing where they would take more than a
    /// hundredth of the run's. Every process must call.
    std::optional<solve::Condition> condition(const std::vector<double>& solution) override;

  private:
    struct Residual {
        double norm, relative;
        double linear_norm, nonlinear_norm;  ///< |A x|, |F(x)|
    };

    Residual residual(solve::NonlinearTerm& F, Vec x);
    void update_tangent(solve::NonlinearTerm& F);
    bool solve_linear(double tolerance);
    void polish(solve::NonlinearTerm& F, Residual& current);
    double goal() const;
    bool is_round_off(solve::NonlinearTerm& F, const Residual& current);
    double round_off(solve::NonlinearTerm& F);
    bool estimate_is_cheap() const;
    Eigen::VectorXd whole(const std::vector<double>& local, bool adds_up) const;
    std::optional<Eigen::VectorXd> solve_whole(const Eigen::VectorXd& rhs, bool transposed);
    void take(Vec x);
    void renew_hierarchy();
    void free_only(std::vector<double>& local) const;
    void make_solver();
    static PetscErrorCode precondition(PC shell, Vec r, Vec z);

    std::string name_;
    const fem::BlockMatrix* matrix_;
    const parallel::NodeNumbers* numbers_;
    const parallel::Team* team_;
    std::vector<char> fixed_;
    solve::NewtonOptions options_;
    bool symmetric_;
    std::vector<std::int32_t> contact_dofs_;
    bool has_contact_;  ///< on any process
    SharedVectors vectors_;
    Tangent tangent_;
    multigrid::Preconditioner preconditioner_;
    Solver solver_;
    Vector x_, rhs_, linear_, nonlinear_, residual_, update_, candidate_;
    std::vector<double> local_x_, local_, local_z_;
    Eigen::VectorXd contact_x_, contact_F_;
    double rounding_ = 0;               ///< the relative residual that rounding has left, as far as is known
    bool began_ = false;                ///< a solve, so that there is a tangent
    std::int64_t iterations_ = 0;       ///< of all linear solves
    std::optional<double> fresh_rate_;  ///< iterations a digit with a new hierarchy; empty: time for one
};

class NewtonKrylov final : public solve::Strategy {
  public:
    NewtonKrylov(const parallel::Part& part, const parallel::Team& team) : part_(&part), team_(&team) {}
    std::string name() const override { return "newton-krylov"; }
    const parallel::Team& team() const override { return *team_; }
    std::unique_ptr<solve::StepProblem> prepare(const solve::StepProblemInput& input) override {
        return std::make_unique<KrylovProblem>(input, *part_, *team_);
    }

  private:
    const parallel::Part* part_;
    const parallel::Team* team_;
};

}  // namespace thermocontact::petsc

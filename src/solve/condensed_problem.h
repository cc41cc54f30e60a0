/// Strategy "condensed" (MODEL.md, 5): one Cholesky factor with the contact unknowns last, dense Newton on
/// them.
#pragma once

#include <functional>

#include "solve/condensed_system.h"
#include "solve/refinement.h"
#include "solve/step_problem.h"

namespace thermocontact::solve {

class CondensedProblem : public StepProblem {
  public:
    /// What `input` and `interior` refer to must stay.
    CondensedProblem(const StepProblemInput& input, std::span<const std::int32_t> interior,
                     std::shared_ptr<Workers> workers, Storage storage);

    const std::vector<std::int32_t>& contact_dofs() const override { return system_.contact_dofs(); }
    Eigen::VectorXd begin(const std::vector<double>& rhs, const std::vector<double>& start) override;
    NewtonResult solve(NonlinearTerm& F, Eigen::VectorXd& x) override;
    void evaluate_at(const Eigen::VectorXd& x, NonlinearTerm& F) override;
    double largest_unknown(const Eigen::VectorXd& start) override;
    bool finish(const Eigen::VectorXd& x, std::vector<double>& solution) override;
    NewtonResult refine(NonlinearTerm& F, Eigen::VectorXd& x, std::vector<double>& solution) override;
    std::optional<KeptDerivative> kept_derivative() const override;
    void take_up(const KeptDerivative& derivative) override;
    std::optional<Condition> condition(const std::vector<double>& solution) override;
    FactorSize factor_size() const override { return {system_.factor_entries(), system_.factor_bytes()}; }
    FactorUse factor_use() const override { return {correction_.has_value(), too_coarse_, corrections_}; }

  private:
    /// For a solution that is reached from a start value, by a factor in words.
    struct Correction {
        Defect defect;   ///< of the start value, later of the solution
        double allowed;  ///< backward error
        const std::vector<double>* rhs = nullptr;
        Eigen::VectorXd start = {};  ///< over the contact unknowns
    };

    Eigen::VectorXd solve_with_factors(const Eigen::VectorXd& rhs, bool transposed);
    Eigen::VectorXd on_contact(const std::vector<double>& values) const;
    void condense_defect(const std::vector<double>& solution);
    void write_contact(const Eigen::VectorXd& x, std::vector<double>& solution) const;
    void use_doubles();
    double backward_error(const Eigen::VectorXd& x, const std::vector<double>& solution);

    const fem::BlockMatrix* matrix_;
    std::function<CondensedSystem(Storage)> make_system_;
    CondensedSystem system_;
    std::optional<Correction> correction_;  ///< empty with a factor in doubles
    Newton newton_;
    Eigen::VectorXd rhs_;      ///< condensed
    bool too_coarse_ = false;  ///< the factor in words, for this matrix
    int corrections_ = 0;      ///< passes beyond the first
};

class Condensed : public Strategy {
  public:
    /// `orders` may hold orders that were computed before.
    explicit Condensed(InteriorOrders orders, Storage storage = Storage::doubles)
        : orders_(std::move(orders)), storage_(storage) {}
    std::string name() const override { return "condensed"; }
    const parallel::Team& team() const override { return alone_; }
    void beside(int count, const std::function<void(int)>& task) const override {
        workers_->run(count, task);
    }
    bool starts_matter() const override { return storage_ == Storage::words; }
    std::unique_ptr<StepProblem> prepare(const StepProblemInput& input) override;

  private:
    parallel::Alone alone_;
    InteriorOrders orders_;
    Storage storage_;
    std::shared_ptr<Workers> workers_ = std::make_shared<Workers>(Workers::available());
};

}  // namespace thermocontact::solve

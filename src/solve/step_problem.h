/// The nonlinear problem of one balance in one step, A x + F(x) = r with A constant from step to step, and
/// what the strategies that solve it have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fem/block_matrix.h"
#include "parallel/team.h"
#include "solve/condition.h"
#include "solve/newton.h"

namespace thermocontact::solve {

/// How a factor is stored, and what that took.
struct FactorUse {
    bool single = false;      ///< 32 bits a number
    bool too_coarse = false;  ///< that was so, and left
    int corrections = 0;      ///< passes beyond the first of a solve
};

/// Of a sparse factor, where there is one.
struct FactorSize {
    std::int64_t entries = 0;  ///< numbers in L
    std::int64_t bytes = 0;    ///< what is kept of them: equal columns once (equal_fronts.h)
};

class StepProblem {
  public:
    virtual ~StepProblem() = default;

    /// Unknowns that F depends on, in the order in which F takes them; dofs of this process.
    virtual const std::vector<std::int32_t>& contact_dofs() const = 0;

    /// Takes the right-hand side r [dofs] and turns the start value [dofs] into the iterate that the others
    /// work on (its entries are the strategy's own). What processes hold of r at the nodes they share adds
    /// up. `rhs` must stay until refine().
    virtual Eigen::VectorXd begin(const std::vector<double>& rhs, const std::vector<double>& start) = 0;

    /// From the start value in x to the solution; without contact there is nothing to iterate.
    virtual NewtonResult solve(NonlinearTerm& F, Eigen::VectorXd& x) = 0;

    /// Evaluates F at x, so that what F reads is x.
    virtual void evaluate_at(const Eigen::VectorXd& x, NonlinearTerm& F) = 0;

    /// The largest entry of the start value and of the solution without F: a bound of what friction meets.
    virtual double largest_unknown(const Eigen::VectorXd& start) = 0;

    /// Writes the solution into all dofs that are not fixed; false if an entry is not finite, on whichever
    /// process. `solution` holds the start value but for the contact unknowns, where F may have written.
    virtual bool finish(const Eigen::VectorXd& x, std::vector<double>& solution) = 0;

    /// After finish(), brings a solution that a coarse factor left beyond what double precision leaves to
    /// that; `x` and `solution` are improved. The last iterate, and why, if no solution is found.
    virtual NewtonResult refine(NonlinearTerm& F, Eigen::VectorXd& x, std::vector<double>& solution) {
        static_cast<void>(F), static_cast<void>(x), static_cast<void>(solution);
        return {NewtonEnd::converged, 0, 0.0};
    }

    /// What solve() has kept from earlier steps, if it is such that it can be handed on; and an equal problem
    /// to go on with it. Only the last digits of what solve() finds depend on it.
    virtual std::optional<KeptDerivative> kept_derivative() const { return std::nullopt; }
    virtual void take_up(const KeptDerivative&) {}

    /// What the factors at hand leave of the `solution` [dofs] last found, prescribed values included;
    /// nothing where there are none, or a number is not finite. It takes a few solves.
    virtual std::optional<Condition> condition(const std::vector<double>& solution) {
        static_cast<void>(solution);
        return std::nullopt;
    }

    virtual FactorUse factor_use() const { return {}; }

    virtual FactorSize factor_size() const { return {}; }
};

/// What a strategy is told of a balance.
struct StepProblemInput {
    std::string name;  ///< "momentum" or "heat": the prefix of PETSc's options
    const fem::BlockMatrix& matrix;
    const std::vector<char>& fixed;          ///< [dofs]: 1 where a value is prescribed
    const std::vector<char>& contact_nodes;  ///< [nodes]: 1 where F acts
    bool symmetric;                          ///< whether F's derivative is
    NewtonOptions newton;
};

/// A way to solve the steps' problems; it makes one object for each balance of a simulation. The objects
/// refer to the matrix.
class Strategy {
  public:
    virtual ~Strategy() = default;
    virtual std::string name() const = 0;

    /// Calls task(0) to task(count - 1), each once, beside each other where the strategy has threads. Tasks
    /// must not throw, nor call a team.
    virtual void beside(int count, const std::function<void(int)>& task) const {
        for (int number = 0; number < count; ++number) {
            task(number);
        }
    }

    /// Whether its problems take less work with a start value near the solution.
    virtual bool starts_matter() const { return false; }

    /// The processes that solve together.
    virtual const parallel::Team& team() const = 0;

    /// Throws NotPositiveDefinite with the dof where the system shows that it is singular.
    virtual std::unique_ptr<StepProblem> prepare(const StepProblemInput& input) = 0;
};

}  // namespace thermocontact::solve

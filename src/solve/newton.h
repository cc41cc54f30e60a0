/// Newton's method with line search on S x + F(x) = s, dense: the condensed contact problem of one step.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "solve/secants.h"

namespace thermocontact::solve {

/// F and its derivative on the contact unknowns.
class NonlinearTerm {
  public:
    NonlinearTerm() = default;
    NonlinearTerm(NonlinearTerm&&) = default;
    NonlinearTerm& operator=(NonlinearTerm&&) = default;
    virtual ~NonlinearTerm() = default;

    /// F(x) into `value` (overwritten).
    virtual void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) = 0;

    /// One dense piece of dF/dx: the unknowns of its rows and columns (-1: leave out), and the values,
    /// row-major.
    using Piece = std::function<void(std::span<const std::int32_t> unknowns, std::span<const double> values)>;

    /// dF/dx(x) as a sum of pieces.
    virtual void visit_derivative(const Eigen::VectorXd& x, const Piece& visit) = 0;

    /// Adds to `noise` [unknowns] what F changes by, at most, for a relative change of 1 of the data other
    /// than x that it is evaluated from: a multiple of epsilon that rounding these makes. By default nothing.
    virtual void add_sensitivity(const Eigen::VectorXd& x, Eigen::VectorXd& noise) {
        static_cast<void>(x), static_cast<void>(noise);
    }

    /// Adds dF/dx(x) to `matrix`.
    void add_derivative(const Eigen::VectorXd& x, Eigen::MatrixXd& matrix);
};

struct NewtonOptions {
    double tolerance;    ///< on |S x + F - s| / (|S x| + |F| + |s|)
    int max_iterations;  ///< updates of x
};

enum class NewtonEnd {
    converged,
    too_many_iterations,
    cycling,
    line_search_failed,
    not_finite,
    singular,
    not_solved,
    not_reached
};

struct NewtonResult {
    NewtonEnd end;
    int iterations;             ///< updates of x
    double residual;            ///< relative, as in NewtonOptions
    bool at_round_off = false;  ///< converged, with a residual beyond the tolerance that is round-off
    double round_off = 0;       ///< where not converged: what rounding is worth, relative to the same terms
};

/// What solves with one derivative have cost.
struct DerivativeAge {
    int first_iterations = -1;  ///< of the first one that took no other; -1: none yet
    int more_iterations = 0;    ///< than that, of all since
};

/// S + dF/dx where a Newton iteration factored it last, by its entries that differ from S.
struct KeptDerivative {
    std::int64_t unknowns = 0;
    std::vector<std::int64_t> entries = {};  ///< column * unknowns + row
    std::vector<double> values = {};         ///< [entries]
    DerivativeAge age = {};
    bool in_doubles = false;  ///< the sparse factor, as words were too coarse (condensed_problem.h)
};

/// "the line search found no descent", for messages.
const char* describe(NewtonEnd end);

/// Solves one condensed problem after another with the same S. The factors of the last derivative T are kept
/// and used again for as long as they still cut the residual tenfold an iteration, which near a solution they
/// nearly always do, or as much as makes them cheaper than new ones. A step d = -T^-1 r changes S x by
/// S d = -r - (T - S) d, and T - S, of contact alone, is sparse: only where an iteration begins and ends is S
/// read.
class Newton {
  public:
    explicit Newton(NewtonOptions options) : options_(options) {}

    /// From the start value in x to the solution; x is the last iterate if that fails.
    NewtonResult solve(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                       Eigen::VectorXd& x);

    /// The derivative whose factors are kept, if there are any.
    std::optional<KeptDerivative> kept_derivative(const Eigen::MatrixXd& S) const;

    /// Factors the derivative that an iteration with the same S kept, and goes on with it to the last bit.
    /// One of another number of unknowns is passed over.
    void take_up(const Eigen::MatrixXd& S, const KeptDerivative& kept);

    /// cond(T, x) of the derivative whose factors are kept; nothing where there are none.
    std::optional<double> condition(const Eigen::VectorXd& x) const;

    /// S + dF/dx and its factors, as kept; null where there are none.
    const Eigen::MatrixXd* derivative() const { return has_factors_ ? &derivative_ : nullptr; }
    const Eigen::PartialPivLU<Eigen::MatrixXd>& factors() const { return factors_; }

    /// Derivatives factored so far.
    int factorisations() const { return factorisations_; }

  private:
    struct Residual {
        Eigen::VectorXd linear, nonlinear;  ///< S x, F(x)
        bool by_product;                    ///< S x is, not a sum of the changes that steps made
        Eigen::VectorXd value;
        double norm;
        double relative;
        double linear_norm, nonlinear_norm;  ///< |S x|, |F(x)|

        void balance(const Eigen::VectorXd& s);
    };

    /// What rounding x, and the displacement that the gap is computed from, perturb the residual by: eps (|T|
    /// |x| + |dF/du| |u|) with T the current derivative; 0 where there is none yet.
    double round_off(const Eigen::VectorXd& x, NonlinearTerm& F) const;

    /// Whether the residual is round-off. Friction of stiffness mu p / epsilon
    /// magnifies the last bit of a slip velocity, compliance that of a displacement, and no iterate can be
    /// better. Never where it is more than may_be_round_off() allows.
    bool is_round_off(const Eigen::VectorXd& x, NonlinearTerm& F, const Residual& current) const;

    /// One more update with the factors at hand, taken if it lowers the residual, or that of a sum of changes
    /// is within the tolerance: it costs little and brings the solution from there down to round-off.
    void polish(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F, Eigen::VectorXd& x,
                Residual& current);

    NewtonResult iterate(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                         Eigen::VectorXd& x);

    static Residual residual(Eigen::VectorXd linear, bool by_product, const Eigen::VectorXd& s,
                             NonlinearTerm& F, const Eigen::VectorXd& x);
    bool factor(const Eigen::MatrixXd& S, NonlinearTerm& F, const Eigen::VectorXd& x);
    bool factor_derivative(const Eigen::MatrixXd& S);
    NewtonUpdate update(const Residual& current) const;
    bool worth_keeping(double rate, const Residual& next, int iteration) const;
    void weigh_factors(const Eigen::MatrixXd& S, NonlinearTerm& F, const Eigen::VectorXd& x, int iterations);

    NewtonOptions options_;
    Eigen::MatrixXd derivative_;
    Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
    Eigen::SparseMatrix<double> of_contact_;  ///< T - S
    bool has_factors_ = false;
    int factorisations_ = 0;
    DerivativeAge age_;
};

}  // namespace thermocontact::solve

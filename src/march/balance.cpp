#include "march/balance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.h"
#include "march/vectors.h"
#include "number.h"
#include "solve/available_memory.h"
#include "solve/panel_factor.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

/// Bytes of a factor that takes less time than to ask how much memory there is.
constexpr double always_fits = 1 << 20;
constexpr int most_updates = 50;  ///< of the friction multiplier in one solve
/// gamma over the body's largest stiffness against slip: an update leaves about 1/stiffening of what sticks
/// wrongly.
constexpr double stiffening = 100;
/// The multipliers of facets with few points that stick, and in space the direction of slip velocities below
/// p_t/gamma, settle more slowly. Where an update after the first `soft_updates` changes more than `slow` of
/// what the last one did, gamma grows, to `stiffest` times its first value at most.
constexpr int soft_updates = 2;
constexpr double slow = 0.1, growth = 10, stiffest = 1e4;
constexpr double falling = 0.5;  ///< of the change before: an update that does some good leaves less

SolveReport report_of(const solve::NewtonResult& result) {
    SolveReport report{.iterations = result.iterations};
    if (result.at_round_off) {
        report.at_round_off = 1;
        report.round_off_residual = result.residual;
    }
    return report;
}

}  // namespace

Balance::Balance(std::string name, const scene::SolverSpec& options, Assembly assembly,
                 model::Prescribed prescribed, std::vector<char> contact_nodes, model::FacetTerm contact,
                 const fem::Space& space, solve::Strategy& strategy, std::vector<double>& unknown)
    : name_(std::move(name)),
      options_{options.tolerance, options.max_iterations},
      assembly_(std::move(assembly)),
      prescribed_(std::move(prescribed)),
      contact_nodes_(std::move(contact_nodes)),
      contact_(std::move(contact)),
      space_(&space),
      strategy_(&strategy),
      unknown_(&unknown),
      memory_of_others_(share_left * solve::available_memory()) {}

void Balance::use(double tau) {
    recency_.note(tau);
    const auto found = std::ranges::find(systems_, tau, [](const auto& system) { return system->tau; });
    if (found != systems_.end()) {
        std::rotate(systems_.begin(), found, found + 1);
    } else {
        const double bytes = systems_.empty() ? 0.0 : static_cast<double>(factor_size().bytes);
        const std::size_t kept = bytes < always_fits
                                     ? systems_.size()
                                     : factors_beside_another(systems_.size(), bytes,
                                                              solve::available_memory() - memory_of_others_);
        systems_.resize(std::min(kept, most_systems_ - 1));
        auto system = timed(factor_seconds_, [&] { return prepare(tau); });
        ++factorisations_;
        systems_.insert(systems_.begin(), std::move(system));
        contact_.restrict_to(problem().contact_dofs());
    }
    contact_.set_step(tau);
    contact_.set_slip_stiffness(systems_.front()->slip_stiffness);
}

std::vector<KeptSystem> Balance::kept_systems() const {
    std::vector<KeptSystem> kept;
    for (const auto& system : systems_) {
        if (auto derivative = system->problem->kept_derivative()) {
            kept.push_back({system->tau, std::move(*derivative)});
        }
    }
    return kept;
}

void Balance::take_up(const std::vector<KeptSystem>& kept) {
    std::for_each(kept.rbegin(), kept.rend(), [this](const KeptSystem& system) {
        use(system.tau);
        problem().take_up(system.derivative);
    });
}

std::unique_ptr<Balance::System> Balance::prepare(double tau) {
    auto system = std::make_unique<System>(System{tau, assembly_(tau), nullptr});
    if (contact_.has_exact_friction()) {
        system->slip_stiffness =
            stiffening * strategy_->team().max(contact_.stiffness_against_slip(system->matrix));
    }
    const bool symmetric = !contact_.has_friction();
    const solve::StepProblemInput input{name_,          system->matrix, prescribed_.fixed(),
                                        contact_nodes_, symmetric,      options_};
    try {
        system->problem = strategy_->prepare(input);
    } catch (const solve::NotPositiveDefinite& failure) {
        const mesh::Point& x = space_->nodes[static_cast<std::size_t>(failure.row / input.matrix.rows)];
        throw NumericsError(
            name_ + " balance: the system is singular or indefinite, seen at (" + short_text(x[0]) + ", " +
            short_text(x[1]) + ") component " + std::to_string(failure.row % input.matrix.rows) +
            "; the body may be free to move, or a tensor not positive; prescribe a value on a "
            "boundary, or add density (heat: capacity)");
    }
    return system;
}

void Balance::remove_prescribed(std::vector<double>& rhs) {
    const auto value = [&](std::int32_t dof) { return (*unknown_)[static_cast<std::size_t>(dof)]; };
    if (std::ranges::all_of(prescribed_.dofs(), [&](std::int32_t dof) { return value(dof) == 0.0; })) {
        return;
    }
    std::vector<double> values(rhs.size(), 0.0);
    for (const std::int32_t dof : prescribed_.dofs()) {
        values[static_cast<std::size_t>(dof)] = value(dof);
    }
    as_eigen(rhs) -= as_eigen(systems_.front()->matrix.multiply(values));
}

void Balance::look_for_free_motions(const parallel::NodeNumbers& numbers, int components,
                                    const FreeMotionWords& words, const std::vector<char>& held,
                                    const model::Springs* springs) {
    std::vector<char> fixed = prescribed_.fixed();
    for (std::size_t i = 0; i < held.size(); ++i) {
        fixed[i] = fixed[i] != 0 || held[i] != 0 ? 1 : 0;
    }
    free_motions_.emplace(*space_, numbers, strategy_->team(), fixed, components);
    if (springs != nullptr) {
        free_motions_->hold(*springs);
    }
    words_ = words;
    contact_.set_step(1.0);  // until use() says otherwise
}

std::optional<std::string> Balance::what_is_free() {
    const auto found = free_motions_ ? free_motions_->left_by(contact_) : std::nullopt;
    if (!found) {
        return std::nullopt;
    }
    const std::string contact = contact_.empty()      ? "there is no contact"
                                : found->contact_acts ? "contact does not resist it as it is closed"
                                                      : words_.idle;
    return "the system is singular: " + found->motions + ", for there is no " + words_.lacking + ", no " +
           words_.prescribed + " is prescribed that would prevent it, and " + contact + "; " + words_.advice;
}

void Balance::require_held() {
    if (const auto text = what_is_free()) {
        throw NumericsError(name_ + " balance: " + *text);
    }
}

SolveReport Balance::solve(std::vector<double>& rhs) {
    solved_ = false;
    remove_prescribed(rhs);
    const std::vector<double> start = free_motions_ ? *unknown_ : std::vector<double>();
    Eigen::VectorXd x = timed(seconds_.triangular_solves, [&] { return problem().begin(rhs, *unknown_); });
    SolveReport report;
    try {
        report = timed(seconds_.newton, [&] { return solve_contact(x); });
    } catch (const StepFailure& failure) {
        if (free_motions_) {
            *unknown_ = start;
            if (const auto text = what_is_free()) {
                throw NumericsError(std::string(failure.what()) + "; " + *text);
            }
        }
        problem().finish(x, *unknown_);
        throw;
    }
    const bool finite = timed(seconds_.triangular_solves, [&] { return problem().finish(x, *unknown_); });
    if (!finite) {
        throw StepFailure(name_ + " balance: the solution is not finite");
    }
    const solve::NewtonResult refined =
        timed(seconds_.triangular_solves, [&] { return problem().refine(contact_, x, *unknown_); });
    if (refined.end != solve::NewtonEnd::converged) {
        throw StepFailure(why_not(x, refined, nullptr));
    }
    report.add(report_of(refined));
    solved_ = true;
    return report;
}

solve::NewtonResult Balance::iterate(Eigen::VectorXd& x) {
    const solve::NewtonResult result = problem().solve(contact_, x);
    cycles_ += result.end == solve::NewtonEnd::cycling ? 1 : 0;
    return result;
}

/// Method of multipliers (forms/coulomb.py): solved for a multiplier, which then becomes the friction found,
/// until that changes no more than rounding the slip does: relative to its own size, for a small friction on
/// a large body is below what Newton's method is asked for. It polishes even so (Newton::polish), and where
/// it has nothing to do and the changes fall no more, round-off is all that is left of them. Where no point
/// begins or ends to stick, the derivative stays as it is, and a turn costs a solve with the factors at hand.
SolveReport Balance::solve_contact(Eigen::VectorXd& x) {
    contact_.set_slip_stiffness(systems_.front()->slip_stiffness);
    SolveReport report = solve_given_multipliers(x);
    if (!contact_.has_exact_friction()) {
        return report;
    }
    double stiffness = systems_.front()->slip_stiffness, change = 0;
    const double most = stiffest * stiffness;
    bool moved = true;
    for (int update = 0; update < most_updates; ++update) {
        const double before = change;
        const MultiplierChange now = update_multipliers(x);
        change = now.change;
        if (change <= std::max(options_.tolerance, now.rounding) || (!moved && change > falling * before)) {
            return report;
        }
        if (update >= soft_updates && change > slow * before && stiffness < most) {
            stiffness *= growth;
            contact_.set_slip_stiffness(stiffness);
        }
        const SolveReport next = solve_given_multipliers(x);
        report.add(next);
        moved = next.iterations > 0;
    }
    throw StepFailure(name_ + " balance: which points stick did not settle in " +
                      std::to_string(most_updates) + " updates of the friction multiplier");
}

/// By how much that changes it, relative.
Balance::MultiplierChange Balance::update_multipliers(const Eigen::VectorXd& x) {
    problem().evaluate_at(x, contact_);
    const auto [change, size, rounding] = contact_.update_multipliers();
    std::vector<double> sums{change, size, rounding};
    strategy_->team().sum(sums);
    const double fastest =
        strategy_->team().max((x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0) + contact_.largest_foundation());
    const double scale = sums[1] > 0 ? std::sqrt(sums[1]) : 1.0;
    return {std::sqrt(sums[0]) / scale, std::sqrt(sums[2]) * fastest / scale};
}

SolveReport Balance::solve_given_multipliers(Eigen::VectorXd& x) {
    const Eigen::VectorXd start = x;
    const solve::NewtonResult direct = iterate(x);
    if (direct.end == solve::NewtonEnd::converged) {
        return report_of(direct);
    }
    if (!contact_.has_exact_friction() && contact_.smallest_regularisation() == 0) {
        throw StepFailure(why_not(x, direct, nullptr));
    }
    // the fastest unknown bounds the slip: friction regularised at that velocity is nearly linear; and the
    // largest difference to the foundation's temperature: conductance limited there is linear
    x = start;
    const double fastest =
        problem().largest_unknown(start) + strategy_->team().max(contact_.largest_foundation());
    contact_.set_width_of_exact_friction(fastest / stiffening);
    const double target = contact_.smallest_regularisation();
    if (target == 0) {
        throw StepFailure(why_not(x, direct, nullptr));
    }
    const auto rung = [&](double floor, Eigen::VectorXd& value) {
        contact_.raise_regularisation(floor);
        return iterate(value);
    };
    const solve::ContinuationResult ladder = solve::continue_regularisation(rung, fastest, target, x);
    contact_.raise_regularisation(0);
    if (ladder.newton.end != solve::NewtonEnd::converged) {
        throw StepFailure(why_not(x, direct, &ladder));
    }
    SolveReport report = report_of(ladder.newton);
    report.iterations += direct.iterations;
    report.retries = ladder.rungs;
    return report;
}

}  // namespace thermocontact::march

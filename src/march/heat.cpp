#include "march/heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "march/assembler.h"
#include "march/audit_limit.h"
#include "march/course.h"
#include "model/convection.h"
#include "parallel/together.h"

namespace thermocontact::march {
namespace {

model::FacetTerm contact_term(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                              const model::ContactSurfaces& surfaces, const std::vector<double>& displacement,
                              const std::vector<std::vector<double>>& foundations,
                              std::vector<double>& excess) {
    model::FacetTerm term(space, 1, excess);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto& surface = surfaces[i];
        if (surface->laws.conductance) {
            const fem::Fields fields{{"theta", {&excess, 1, &space.dofmap}},
                                     {"theta_F", {&foundations[i], 1, &space.dofmap}},
                                     {"u", {&displacement, scene.dimension, &space.dofmap}},
                                     {"g", {&surface->gap, 1, &space.dofmap}}};
            term.add("conductance", mesh, *surface, model::contact_constants(surface->laws, 0.0), fields);
        }
    }
    return term;
}

/// Whether the last bits of temperatures are worth more than an audit may have of the flows through contact,
/// as the fields are that its term reads; `other` flows (W) count beside those.
bool rounds_flows(Balance& balance, const parallel::Team& team, double other) {
    if (balance.contact().empty()) {
        return false;
    }
    const std::vector<std::int32_t>& dofs = balance.contact_dofs();
    Eigen::VectorXd theta(static_cast<Eigen::Index>(dofs.size()));
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        theta[static_cast<Eigen::Index>(i)] = balance.solution()[static_cast<std::size_t>(dofs[i])];
    }
    const std::vector<double> magnitudes = balance.contact().magnitudes(theta);
    std::vector<double> flows(balance.solution().size(), 0.0);
    balance.contact().nodal_forces("conductance", flows);
    std::vector<double> sums{std::accumulate(magnitudes.begin(), magnitudes.end(), 0.0),
                             as_eigen(std::as_const(flows)).lpNorm<1>() + other};
    team.sum(sums);
    return std::numeric_limits<double>::epsilon() * sums[0] > least_audit * sums[1];
}

/// A = c / tau + K + h.
fem::BlockMatrix system_matrix(const fem::NodeGraph& graph, double tau,
                               const std::optional<fem::BlockMatrix>& capacity,
                               const std::optional<fem::BlockMatrix>& conduction,
                               const std::optional<fem::BlockMatrix>& exchange) {
    fem::BlockMatrix matrix = fem::zero_matrix(graph, 1, 1);
    if (capacity) {
        matrix.add(1 / tau, *capacity);
    }
    if (conduction) {
        matrix.add(1, *conduction);
    }
    if (exchange) {
        matrix.add(1, *exchange);
    }
    return matrix;
}

}  // namespace

Heat::Heat(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
           const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
           const State& initial, const model::Motion& stage_motion, const std::vector<model::Source>& sources)
    : team_(&strategy.team()),
      capacity_density_(model::uniform_capacity(scene)),
      loads_(parallel::together(*team_, [&] { return model::Loads::thermal(scene, mesh, space, sources); })),
      friction_heat_(surfaces, mesh, space, scene.dimension, stage_motion),
      surfaces_(&surfaces),
      stage_(initial.temperature),
      reference_(initial.temperature.size(), 0.0),
      excess_(initial.temperature),
      foundations_(surfaces.size()) {
    const Assembler assemble{scene, mesh, space, graph};
    capacity_ = assemble.when(scene.heat->capacity.has_value(), "heat_capacity.capacity", 1, 1);
    conduction_ = assemble.when(scene.heat->conductivity.has_value(), "conduction.conduction", 1, 1);
    strain_heating_ =
        assemble.when(scene.heat->strain_heating.has_value(), "strain_heating.coupling", 1, scene.dimension);
    strain_rate_heating_ = assemble.when(scene.heat->strain_rate_heating.has_value(),
                                         "strain_heating.rate_coupling", 1, scene.dimension);
    exchange_ = model::convection_matrix(scene, mesh, space, graph);
    if (exchange_) {
        ambient_ = parallel::together(*team_, [&] { return model::Loads::ambient(scene, mesh, space); });
    }
    gram_ = assemble.when(!capacity_density_, "norms.temperature", 1, 1);
    const std::vector<double>* stage_displacement = stage_motion.displacement;
    if (stage_displacement == nullptr) {
        no_displacement_.assign(space.nodes.size() * static_cast<std::size_t>(scene.dimension), 0.0);
        stage_displacement = &no_displacement_;
    }
    balance_ = std::make_unique<Balance>(
        "heat", scene.solver,
        [&graph, this](double tau) { return system_matrix(graph, tau, capacity_, conduction_, exchange_); },
        model::Prescribed::temperature(scene, mesh, space),
        model::nodes_with(surfaces, space, &scene::Contact::conductance),
        contact_term(scene, mesh, space, surfaces, *stage_displacement, foundations_, excess_), space,
        strategy, excess_);
    for (auto* products : {&stored_, &base_stored_, &new_stored_, &conducted_, &outflow_, &source_, &part_,
                           &rhs_, &of_reference_}) {
        products->resize(stage_.size());
    }
    refer_to(nullptr);
    restart(initial);
}

void Heat::restart(const State& state) {
    product(capacity_, state.temperature, stored_);
}

/// theta_ref is the given temperature where the foundation conducts, else 0; 0 everywhere without one.
void Heat::refer_to(const std::vector<double>* temperature) {
    std::ranges::fill(reference_, 0.0);
    for (std::size_t s = 0; s < surfaces_->size(); ++s) {
        const model::ContactSurface& surface = *(*surfaces_)[s];
        if (!surface.laws.conductance) {
            continue;
        }
        foundations_[s].assign(reference_.size(), 0.0);
        for (const std::int32_t node : surface.nodes) {
            const auto i = static_cast<std::size_t>(node);
            reference_[i] = temperature != nullptr ? (*temperature)[i] : 0.0;
            foundations_[s][i] = surface.foundation_temperature[i] - reference_[i];
        }
    }
}

void Heat::begin(const StepRule& rule, const State& state) {
    rule_ = rule;
    balance_->use(rule.tau);
    load_ = parallel::together(*team_, [&] { return &loads_.at(rule.stage_time()); });
    if (ambient_) {
        ambient_load_ = parallel::together(*team_, [&] { return &ambient_->at(rule.stage_time()); });
    }
    if (rule.memory() != 0) {
        extrapolate(rule.memory(), state.temperature, state.temperature_rate, stage_);
        product(capacity_, stage_, base_stored_);
    }
    extrapolate(rule.outlook(), state.temperature, state.temperature_rate, expected_);
    stage_ = expected_;
    follow_course(rule, state, state.temperature, state.temperature_differences,
                  balance_->prescribed().fixed(), stage_);
    new_temperature_ = state.temperature;
    parallel::together(*team_, [&] { balance_->prescribed().apply(rule.end, new_temperature_); });
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        stage_[i] = state.temperature[i] + rule.alpha * (new_temperature_[i] - state.temperature[i]);
    }
}

/// Heat of strain, of its rate and of friction; what is absent costs nothing.
void Heat::gather_sources(const model::Motion& motion) {
    const auto sum_of = [](const std::vector<double>& flows) {
        return Sum{as_eigen(flows).sum(), as_eigen(flows).lpNorm<1>()};
    };
    std::ranges::fill(source_, 0.0);
    strain_ = strain_rate_ = friction_ = {};
    if (strain_heating_) {
        strain_heating_->multiply(*motion.displacement, source_);
        strain_ = sum_of(source_);
    }
    if (strain_rate_heating_) {
        strain_rate_heating_->multiply(*motion.velocity, part_);
        strain_rate_ = sum_of(part_);
        as_eigen(source_) += as_eigen(std::as_const(part_));
    }
    if (!friction_heat_.empty()) {
        std::ranges::fill(part_, 0.0);
        friction_heat_.add_to(part_);
        friction_ = sum_of(part_);
        as_eigen(source_) += as_eigen(std::as_const(part_));
    }
}

/// Where conductance is so large that the last bit of a temperature is worth more flow than the tolerance, or
/// than audits may have, the step is solved once more for the difference to what was found, which has all its
/// digits.
SolveReport Heat::solve(const model::Motion& motion) {
    gather_sources(motion);
    const std::vector<double> start = stage_;
    refer_to(nullptr);
    std::optional<SolveReport> first;
    try {
        first = solve_from_reference();
    } catch (const StepFailure&) {
        const bool finite = std::ranges::all_of(stage_, [](double theta) { return std::isfinite(theta); });
        if (balance_->contact().empty() || team_->any(!finite)) {
            throw;
        }
    }
    const double other =
        as_eigen(*load_).lpNorm<1>() + strain_.magnitude + strain_rate_.magnitude + friction_.magnitude;
    if (first && first->at_round_off == 0 && !rounds_flows(*balance_, *team_, other)) {
        return *first;
    }
    const std::vector<double> found = stage_;
    try {
        refer_to(&found);
        SolveReport report = solve_from_reference();
        report.iterations += first ? first->iterations : 0;
        report.retries += (first ? first->retries : 0) + (first && first->at_round_off == 0 ? 0 : 1);
        return report;
    } catch (const StepFailure&) {
        if (!first) {
            stage_ = start;
            throw;
        }
    }
    refer_to(nullptr);
    stage_ = excess_ = found;
    return *first;
}

SolveReport Heat::solve_from_reference() {
    as_eigen(rhs_) =
        as_eigen(*load_) + as_eigen(base_stored()) / rule_.tau + as_eigen(std::as_const(source_));
    if (ambient_load_ != nullptr) {
        as_eigen(rhs_) += as_eigen(*ambient_load_);
    }
    if (std::ranges::any_of(reference_, [](double theta) { return theta != 0; })) {
        product(capacity_, reference_, of_reference_);
        as_eigen(rhs_) -= as_eigen(std::as_const(of_reference_)) / rule_.tau;
        for (const auto* matrix : {&conduction_, &exchange_}) {
            product(*matrix, reference_, of_reference_);
            as_eigen(rhs_) -= as_eigen(std::as_const(of_reference_));
        }
    }
    as_eigen(excess_) = as_eigen(std::as_const(stage_)) - as_eigen(std::as_const(reference_));
    const auto take = [&] {
        for (std::size_t i = 0; i < stage_.size(); ++i) {
            if (balance_->prescribed().fixed()[i] == 0) {
                stage_[i] = reference_[i] + excess_[i];
            }
        }
    };
    try {
        const SolveReport report = balance_->solve(rhs_);
        take();
        return report;
    } catch (const StepFailure&) {
        take();
        throw;
    }
}

/// The prescribed temperatures are those of begin(), to the last bit.
void Heat::complete(const State& state) {
    for (std::size_t i = 0; i < stage_.size(); ++i) {
        if (balance_->prescribed().fixed()[i] == 0) {
            new_temperature_[i] = rule_.completed(state.temperature[i], stage_[i]);
        }
    }
}

FieldError Heat::temperature_error(const State& state) const {
    if (!capacity_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.temperature, new_temperature_,
                                         state.temperature_rate, state.temperature_curvature);
    return {estimate.empty() ? 0.0 : temperature_norm(estimate), temperature_norm(new_temperature_)};
}

void Heat::accept(State& state, const Scheme& scheme) {
    add_to_audit();
    renew_rates(scheme, rule_, state.temperature, new_temperature_, state.temperature_rate,
                state.temperature_curvature);
    if (balance_->starts_matter()) {
        renew_course(rule_, state, state.temperature, new_temperature_, state.temperature_differences);
    }
    std::swap(stored_, new_stored_);
    std::swap(state.temperature, new_temperature_);
}

double Heat::temperature_norm(const std::vector<double>& theta) const {
    return norm(theta, (gram_ ? *gram_ : *capacity_).multiply(theta));
}

double Heat::content(const State& state) const {
    return team_->sum(capacity_ ? as_eigen(capacity_->multiply(state.temperature)).sum() : 0.0);
}

double Heat::norm(const std::vector<double>& theta, const std::vector<double>& product) const {
    // the capacity matrix is c times the Gram matrix
    const double square =
        team_->sum(as_eigen(theta).dot(as_eigen(product))) / capacity_density_.value_or(1.0);
    return std::sqrt(std::max(0.0, square));
}

StepSeconds Heat::seconds() const {
    StepSeconds seconds = balance_->seconds();
    seconds.audit = audit_seconds_;
    return seconds;
}

}  // namespace thermocontact::march

#include "march/heat.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "march/assembler.h"
#include "march/audit_limit.h"
#include "march/course.h"
#include "march/vectors.h"
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

/// A = c / tau + K + h.
fem::BlockMatrix system_matrix(const fem::NodeGraph& graph, double tau,
                               const std::optional<fem::BlockMatrix>& capacity,
                               const std::optional<fem::BlockMatrix>& conduction,
                               const std::optional<fem::BlockMatrix>& exchange) {
    fem::BlockMatrix matrix = fem::zero_matrix(graph, 1, 1);
    if (capacity) {
        matrix.add(1 / tau, *capacity);
    }
    for (const auto* part : {&conduction, &exchange}) {
        if (*part) {
            matrix.add(1, **part);
        }
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
      foundations_(surfaces.size(), std::vector<double>(initial.temperature.size(), 0.0)),
      traversal_(graph, [&strategy](int count, const std::function<void(int)>& task) {
          strategy.beside(count, task);
      }) {
    const Assembler assemble{scene, mesh, space, graph};
    const scene::Heat& heat = *scene.heat;
    assemble_beside(strategy, {assemble.into(strain_heating_, heat.strain_heating, "strain_heating.coupling",
                                             1, scene.dimension),
                               assemble.into(strain_rate_heating_, heat.strain_rate_heating,
                                             "strain_heating.rate_coupling", 1, scene.dimension),
                               assemble.into(conduction_, heat.conductivity, "conduction.conduction", 1, 1),
                               assemble.into(capacity_, heat.capacity, "heat_capacity.capacity", 1, 1),
                               assemble.into(gram_, !capacity_density_, "norms.temperature", 1, 1)});
    exchange_ = model::convection_matrix(scene, mesh, space, graph);
    if (exchange_) {
        ambient_ = parallel::together(*team_, [&] { return model::Loads::ambient(scene, mesh, space); });
    }
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
                           &rhs_, &of_reference_, &extrapolated_, &new_temperature_}) {
        products->resize(stage_.size());
    }
    contact_nodes_ = balance_->contact().nodes_with_forces();
    if (conduction_) {
        prescribed_rows_.emplace(*conduction_, balance_->prescribed().dofs());
    }
    refer_to(nullptr);
    restart(initial);
}

void Heat::restart(const State& state) {
    multiply({{.matrix = pointer(capacity_), .x = &state.temperature, .y = &stored_}});
}

/// theta_ref is the given temperature where the foundation conducts, else 0; 0 everywhere without one.
void Heat::refer_to(const std::vector<double>* temperature) {
    referred_ = false;
    for (std::size_t s = 0; s < surfaces_->size(); ++s) {
        const model::ContactSurface& surface = *(*surfaces_)[s];
        if (!surface.laws.conductance) {
            continue;
        }
        for (const std::int32_t node : surface.nodes) {
            const auto i = static_cast<std::size_t>(node);
            reference_[i] = temperature != nullptr ? (*temperature)[i] : 0.0;
            referred_ = referred_ || reference_[i] != 0;
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
    const auto go_on = [&](double seconds, Nodal& result) {
        traversal_.each([&](fem::NodeRange range, std::size_t) {
            extrapolate(seconds, state.temperature, state.temperature_rate, range.begin, range.end, result);
        });
    };
    if (rule.memory() != 0) {
        go_on(rule.memory(), stage_);
        multiply({{.matrix = pointer(capacity_), .x = &stage_, .y = &base_stored_}});
    }
    expected_ = &state.temperature;
    if (rule.outlook() != 0 && !state.temperature_rate.empty()) {
        go_on(rule.outlook(), extrapolated_);
        expected_ = &extrapolated_;
    }
    const auto weights = course_weights(rule, state, state.past_temperature);
    traversal_.each([&](fem::NodeRange range, std::size_t) {
        if (weights) {
            follow_course(*weights, state.temperature, state.past_temperature, balance_->prescribed().fixed(),
                          range, 1, stage_);
        } else {
            std::copy(expected_->begin() + range.begin, expected_->begin() + range.end,
                      stage_.begin() + range.begin);
        }
    });
    parallel::together(*team_, [&] { balance_->prescribed().apply(rule.end, new_temperature_); });
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        stage_[i] = rule.staged(state.temperature[i], new_temperature_[i]);
    }
}

Heat::Sum Heat::sum_over_nodes(const std::vector<double>& flows) const {
    return traversal_.sum<Sum>([flow = flows.data()](fem::NodeRange range) {
        double value = 0, magnitude = 0;
#pragma omp simd reduction(+ : value, magnitude)
        for (std::int32_t i = range.begin; i < range.end; ++i) {
            value += flow[i];
            magnitude += std::abs(flow[i]);
        }
        return Sum{value, magnitude};
    });
}

Heat::Sum Heat::sum_at_contact(const std::vector<double>& flows) const {
    Sum sum;
    for (const std::int32_t node : contact_nodes_) {
        sum.add(flows[static_cast<std::size_t>(node)]);
    }
    return sum;
}

/// Heat of strain, of its rate and of friction; what is absent costs nothing.
void Heat::gather_sources(const model::Motion& motion, bool strain_heat_known) {
    strain_ = strain_rate_ = friction_ = {};
    if (!strain_heat_known) {
        multiply({{.matrix = pointer(strain_heating_), .x = motion.displacement, .y = &source_}});
    }
    if (strain_heating_) {
        strain_ = sum_over_nodes(source_);
    }
    if (strain_rate_heating_) {
        multiply({{.matrix = pointer(strain_rate_heating_), .x = motion.velocity, .y = &part_}});
        strain_rate_ = sum_over_nodes(part_);
        as_eigen(source_) += as_eigen(std::as_const(part_));
    }
    if (!friction_heat_.empty()) {
        std::ranges::fill(part_, 0.0);
        friction_heat_.add_to(part_);
        friction_ = sum_over_nodes(part_);
        as_eigen(source_) += as_eigen(std::as_const(part_));
    }
}

/// Whether the last bits of temperatures are worth more than an audit may have of the flows through contact,
/// as the fields are that its term reads; those in the body count, too.
bool Heat::rounds_flows() {
    if (balance_->contact().empty()) {
        return false;
    }
    const std::vector<std::int32_t>& dofs = balance_->contact_dofs();
    Eigen::VectorXd theta(static_cast<Eigen::Index>(dofs.size()));
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        theta[static_cast<Eigen::Index>(i)] = balance_->solution()[static_cast<std::size_t>(dofs[i])];
    }
    const std::vector<double> magnitudes = balance_->contact().magnitudes(theta);
    balance_->contact().nodal_forces("conductance", outflow_);
    std::vector<double> sums{std::accumulate(magnitudes.begin(), magnitudes.end(), 0.0),
                             sum_at_contact(outflow_).magnitude + sum_over_nodes(*load_).magnitude +
                                 strain_.magnitude + strain_rate_.magnitude + friction_.magnitude};
    team_->sum(sums);
    return std::numeric_limits<double>::epsilon() * sums[0] > least_audit * sums[1];
}

/// Where conductance is so large that the last bit of a temperature is worth more flow than the tolerance, or
/// than audits may have, the step is solved once more for the difference to what was found, which has all its
/// digits.
SolveReport Heat::solve(const model::Motion& motion, bool strain_heat_known) {
    gather_sources(motion, strain_heat_known);
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
    if (first && first->at_round_off == 0 && !rounds_flows()) {
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
            throw;
        }
    }
    refer_to(nullptr);
    stage_ = excess_ = found;
    return *first;
}

SolveReport Heat::solve_from_reference() {
    const std::vector<double>&load = *load_, &stored = base_stored();
    over_dofs(traversal_, 1, [&, tau = rule_.tau](std::size_t i) {
        rhs_[i] = load[i] + stored[i] / tau + source_[i];
        excess_[i] = stage_[i] - reference_[i];
    });
    if (ambient_load_ != nullptr) {
        as_eigen(rhs_) += as_eigen(*ambient_load_);
    }
    if (referred_) {
        for (const auto& [matrix, factor] :
             {std::pair{&capacity_, -1 / rule_.tau}, {&conduction_, -1.0}, {&exchange_, -1.0}}) {
            multiply({{.matrix = pointer(*matrix),
                       .x = &reference_,
                       .y = &of_reference_,
                       .factor = factor,
                       .from = &rhs_}});
            std::swap(rhs_, of_reference_);
        }
    }
    const std::vector<char>& fixed = balance_->prescribed().fixed();
    const auto take = [&] {
        over_dofs(traversal_, 1,
                  [&](std::size_t i) { stage_[i] = fixed[i] == 0 ? reference_[i] + excess_[i] : stage_[i]; });
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
    if (rule_.ends_at_stage()) {
        return;
    }
    const std::vector<char>& fixed = balance_->prescribed().fixed();
    over_dofs(traversal_, 1, [&, rule = rule_](std::size_t i) {
        const double theta = rule.completed(state.temperature[i], stage_[i]);
        new_temperature_[i] = fixed[i] == 0 ? theta : new_temperature_[i];
    });
}

FieldError Heat::temperature_error(const State& state) const {
    if (!capacity_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.temperature, new_temperature(),
                                         state.temperature_rate, state.temperature_curvature);
    return {estimate.empty() ? 0.0 : temperature_norm(estimate), temperature_norm(new_temperature())};
}

void Heat::accept(State& state, const Scheme& scheme) {
    add_to_audit();
    Nodal& reached = rule_.ends_at_stage() ? stage_ : new_temperature_;
    renew_rates(scheme, rule_, state.temperature, reached, state.temperature_rate,
                state.temperature_curvature);
    std::swap(stored_, new_stored_);
    if (balance_->starts_matter()) {
        renew_course(state.past_temperature, state.temperature, reached);
    } else {
        std::swap(state.temperature, reached);
    }
}

double Heat::temperature_norm(const std::vector<double>& theta) const {
    return norm((gram_ ? *gram_ : *capacity_).quadratic_form(theta));
}

double Heat::content(const State& state) const {
    return team_->sum(capacity_ ? as_eigen(capacity_->multiply(state.temperature)).sum() : 0.0);
}

StepSeconds Heat::seconds() const {
    StepSeconds seconds = balance_->seconds();
    seconds.audit = audit_seconds_;
    return seconds;
}

}  // namespace thermocontact::march

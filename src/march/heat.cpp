#include "march/heat.h"

#include <cmath>

#include "march/assembler.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

model::FacetTerm contact_term(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                              const model::ContactSurfaces& surfaces, const std::vector<double>& displacement,
                              std::vector<double>& temperature) {
    model::FacetTerm term(space, 1, temperature);
    for (const auto& surface : surfaces) {
        if (surface->laws.conductance) {
            const fem::Fields fields{{"theta", {&temperature, 1, &space.dofmap}},
                                     {"theta_F", {&surface->foundation_temperature, 1, &space.dofmap}},
                                     {"u", {&displacement, scene.dimension, &space.dofmap}},
                                     {"g", {&surface->gap, 1, &space.dofmap}}};
            term.add("conductance", mesh, *surface, model::contact_constants(surface->laws, 0.0), fields);
        }
    }
    return term;
}

/// A = c / k + K.
fem::BlockMatrix system_matrix(const fem::NodeGraph& graph, double k,
                               const std::optional<fem::BlockMatrix>& capacity,
                               const std::optional<fem::BlockMatrix>& conduction) {
    fem::BlockMatrix matrix = fem::zero_matrix(graph, 1, 1);
    if (capacity) {
        matrix.add(1 / k, *capacity);
    }
    if (conduction) {
        matrix.add(1, *conduction);
    }
    return matrix;
}

}  // namespace

Heat::Heat(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
           const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
           const State& state, double k, const std::vector<model::Source>& sources)
    : team_(&strategy.team()),
      step_(k),
      capacity_density_(model::uniform_capacity(scene)),
      loads_(model::Loads::thermal(scene, mesh, space, sources)),
      trial_(state.temperature) {
    const Assembler assemble{scene, mesh, space, graph};
    capacity_ = assemble.when(scene.heat->capacity.has_value(), "heat_capacity.capacity", 1, 1);
    conduction_ = assemble.when(scene.heat->conductivity.has_value(), "conduction.conduction", 1, 1);
    strain_heating_ =
        assemble.when(scene.heat->strain_heating.has_value(), "strain_heating.coupling", 1, scene.dimension);
    gram_ = assemble.when(!capacity_density_, "norms.temperature", 1, 1);
    if (!scene.material) {
        no_displacement_.assign(space.nodes.size() * static_cast<std::size_t>(scene.dimension), 0.0);
    }
    const std::vector<double>& displacement = scene.material ? state.displacement : no_displacement_;
    balance_ = std::make_unique<Balance>(
        "heat", scene.solver, system_matrix(graph, k, capacity_, conduction_),
        model::Prescribed::temperature(scene, mesh, space),
        model::nodes_with(surfaces, space, &scene::Contact::conductance),
        contact_term(scene, mesh, space, surfaces, displacement, trial_), space, strategy, trial_);
    for (auto* products : {&stored_, &new_stored_, &conducted_, &outflow_, &strain_source_}) {
        products->resize(trial_.size());
    }
    product(capacity_, state.temperature, stored_);
    product(strain_heating_, state.displacement, strain_source_);
}

SolveReport Heat::advance(double time, State& state) {
    const std::vector<double>& load = loads_.at(time);
    std::vector<double> rhs(load.size());
    as_eigen(rhs) =
        as_eigen(load) + as_eigen(std::as_const(stored_)) / step_ + as_eigen(std::as_const(strain_source_));
    trial_ = state.temperature;
    balance_->prescribed().apply(time, trial_);
    const SolveReport report = balance_->solve(rhs);
    timed(audit_seconds_, [&] { audit(load); });
    std::swap(stored_, new_stored_);
    product(strain_heating_, state.displacement, strain_source_);
    state.temperature = trial_;
    return report;
}

void Heat::audit(const std::vector<double>& load) {
    product(capacity_, trial_, new_stored_);
    product(conduction_, trial_, conducted_);
    balance_->contact().nodal_forces("conductance", outflow_);
    const Eigen::VectorXd storage =
        (as_eigen(std::as_const(new_stored_)) - as_eigen(std::as_const(stored_))) / step_;
    const Eigen::VectorXd residual = storage + as_eigen(std::as_const(conducted_)) +
                                     as_eigen(std::as_const(outflow_)) - as_eigen(load) -
                                     as_eigen(std::as_const(strain_source_));
    const auto strain = as_eigen(std::as_const(strain_source_)), flow = as_eigen(std::as_const(outflow_));
    struct Sums {  // scale: the magnitude of what is summed, as inflow on one side and outflow on the other
                   // still count
        double storage, outflow, reaction, load, strain, scale;
    };
    Sums here{storage.sum(),
              flow.sum(),
              0,
              as_eigen(load).sum(),
              strain.sum(),
              storage.lpNorm<1>() + flow.lpNorm<1>() + as_eigen(load).lpNorm<1>() + strain.lpNorm<1>()};
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        here.reaction += residual[dof];
        here.scale += std::abs(residual[dof]);
    }
    const Sums sums = team_->summed(here);
    const Record terms{{"heat_storage_rate", sums.storage},
                       {"contact_heat_outflow", sums.outflow},
                       {"prescribed_temperature_inflow", sums.reaction},
                       {"load_heat_inflow", sums.load},
                       {"strain_heat_inflow", sums.strain}};
    const double sum = sums.storage + sums.outflow - sums.reaction - sums.load - sums.strain;
    heat_residual_ = sums.scale > 0 ? std::abs(sum) / sums.scale : 0.0;
    record_ = {{"temperature_l2", capacity_density_ ? norm(trial_, new_stored_) : temperature_norm(trial_)}};
    record_.insert(record_.end(), terms.begin(), terms.end());
    record_.emplace_back("heat_residual", heat_residual_);
}

double Heat::temperature_norm(const std::vector<double>& theta) const {
    return norm(theta, (gram_ ? *gram_ : *capacity_).multiply(theta));
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

#include "march/momentum.h"

#include <cmath>

#include "march/assembler.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

model::FacetTerm contact_term(const mesh::Mesh& mesh, const fem::Space& space, int dimension,
                              const model::ContactSurfaces& surfaces,
                              const std::vector<double>& old_displacement, std::vector<double>& velocity,
                              double k) {
    model::FacetTerm term(space, dimension, velocity);
    for (const auto& surface : surfaces) {
        const fem::Fields fields{{"w", {&velocity, dimension, &space.dofmap}},
                                 {"u_old", {&old_displacement, dimension, &space.dofmap}},
                                 {"g", {&surface->gap, 1, &space.dofmap}}};
        const fem::Constants constants = model::contact_constants(surface->laws, k);
        if (surface->laws.compliance) {
            term.add("compliance", mesh, *surface, constants, fields);
        }
        if (surface->laws.friction) {
            term.add("friction", mesh, *surface, constants, fields);
        }
    }
    return term;
}

/// A = rho M / k + V + k E.
fem::BlockMatrix system_matrix(const fem::NodeGraph& graph, int dimension, double k,
                               const std::optional<fem::BlockMatrix>& mass,
                               const std::optional<fem::BlockMatrix>& damping,
                               const std::optional<fem::BlockMatrix>& stiffness) {
    fem::BlockMatrix matrix = fem::zero_matrix(graph, dimension, dimension);
    if (mass) {
        matrix.add(1 / k, *mass);
    }
    if (damping) {
        matrix.add(1, *damping);
    }
    if (stiffness) {
        matrix.add(k, *stiffness);
    }
    return matrix;
}

}  // namespace

Momentum::Momentum(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                   const fem::NodeGraph& graph, solve::Strategy& strategy,
                   const model::ContactSurfaces& surfaces, const State& initial, double k,
                   const std::vector<model::Source>& sources)
    : team_(&strategy.team()),
      dimension_(scene.dimension),
      step_(k),
      density_(model::uniform_density(scene)),
      loads_(model::Loads::mechanical(scene, mesh, space, sources)),
      trial_(initial.velocity),
      old_displacement_(initial.displacement) {
    const Assembler assemble{scene, mesh, space, graph};
    const int d = dimension_;
    mass_ = assemble.when(scene.material->density.has_value(), "inertia.mass", d, d);
    damping_ = assemble.when(scene.material->viscosity.has_value(), "viscosity.damping", d, d);
    stiffness_ = assemble.when(scene.material->elasticity.has_value(), "elasticity.stiffness", d, d);
    coupling_ = assemble.when(scene.heat && scene.heat->thermal_stress, "thermal_stress.coupling", d, 1);
    velocity_gram_ = assemble.when(!density_, "norms.velocity", d, d);
    strain_gram_ = assemble("norms.strains", d, d);
    balance_ = std::make_unique<Balance>(
        "momentum", scene.solver, system_matrix(graph, d, k, mass_, damping_, stiffness_),
        model::Prescribed::displacement(scene, mesh, space),
        model::nodes_with(surfaces, space, &scene::Contact::compliance),
        contact_term(mesh, space, d, surfaces, old_displacement_, trial_, k), space, strategy, trial_);
    for (auto* compressible : {&mass_, &velocity_gram_}) {
        if (*compressible) {
            (*compressible)->compress();
        }
    }
    for (auto* nodal : {&thermal_, &inertia_, &viscous_, &compliance_, &friction_, &reaction_}) {
        nodal->resize(trial_.size());
    }
    restart(initial);
}

void Momentum::apply(const std::vector<double>& velocity, const std::vector<double>& displacement,
                     Products& products) {
    products.mass_w.resize(velocity.size());
    products.stiffness_u.resize(displacement.size());
    product(mass_, velocity, products.mass_w);
    deformation_ = displacement;
    centre(deformation_, dimension_);
    product(stiffness_, deformation_, products.stiffness_u);
}

void Momentum::restart(const State& state) {
    apply(state.velocity, state.displacement, old_);
}

void Momentum::set_right_hand_side(const std::vector<double>& load) {
    rhs_.resize(load.size());
    as_eigen(rhs_) = as_eigen(load) + as_eigen(std::as_const(old_.mass_w)) / step_ -
                     as_eigen(std::as_const(old_.stiffness_u)) + as_eigen(std::as_const(thermal_));
}

SolveReport Momentum::advance(double time, State& state) {
    const std::vector<double>& load = loads_.at(time);
    product(coupling_, state.temperature, thermal_);
    set_right_hand_side(load);
    std::vector<double> new_u = state.displacement;
    balance_->prescribed().apply(time, new_u);
    trial_ = state.velocity;
    old_displacement_ = state.displacement;
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        trial_[i] = (new_u[i] - state.displacement[i]) / step_;
    }
    const SolveReport report = balance_->solve(rhs_);
    for (std::size_t i = 0; i < new_u.size(); ++i) {
        if (balance_->prescribed().fixed()[i] == 0) {
            new_u[i] += step_ * trial_[i];
        }
    }
    timed(audit_seconds_, [&] { audit(load, state, new_u); });
    state.displacement = std::move(new_u);
    state.velocity = trial_;
    return report;
}

MomentumForces Momentum::collect_forces(const std::vector<double>& load) {
    product(damping_, trial_, viscous_);
    balance_->contact().nodal_forces("compliance", compliance_);
    balance_->contact().nodal_forces("friction", friction_);
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        reaction_[i] = inertia_[i] + viscous_[i] + now_.stiffness_u[i] - thermal_[i] + compliance_[i] +
                       friction_[i] - load[i];
    }
    const auto view = [](const std::vector<double>& v) { return as_eigen(v); };
    return {view(inertia_),  view(viscous_), view(now_.stiffness_u), view(thermal_), view(compliance_),
            view(friction_), view(load),     view(reaction_)};
}

Energies Momentum::energies(const State& old, const std::vector<double>& new_u) {
    Energies sums;  // at shared nodes each process holds a part of M w and K u, so that the sums add up
    for (std::size_t i = 0; i < trial_.size(); ++i) {
        const double mass_change = now_.mass_w[i] - old_.mass_w[i],
                     stiffness_change = now_.stiffness_u[i] - old_.stiffness_u[i];
        inertia_[i] = mass_change / step_;
        sums.kinetic_old += old.velocity[i] * old_.mass_w[i];
        sums.kinetic += trial_[i] * now_.mass_w[i];
        sums.kinetic_numerical += (trial_[i] - old.velocity[i]) * mass_change;
        sums.strain_old += old.displacement[i] * old_.stiffness_u[i];
        sums.strain += new_u[i] * now_.stiffness_u[i];
        sums.strain_numerical += step_ * trial_[i] * stiffness_change;
    }
    for (double Energies::*sum : {&Energies::kinetic_old, &Energies::kinetic, &Energies::kinetic_numerical,
                                  &Energies::strain_old, &Energies::strain, &Energies::strain_numerical}) {
        sums.*sum /= 2;
    }
    return team_->summed(sums);
}

void Momentum::audit(const std::vector<double>& load, const State& old, const std::vector<double>& new_u) {
    apply(trial_, new_u, now_);
    const Energies energy_terms = energies(old, new_u);
    const MomentumForces forces = collect_forces(load);
    const MomentumSums sums = team_->summed(sum_up(forces, as_eigen(std::as_const(trial_)), dimension_));
    const Audit energy = audit_energy(energy_terms, sums, step_);
    const Audit force = audit_forces(sums, dimension_);
    std::swap(old_, now_);
    energy_residual_ = energy.residual;
    force_residual_ = force.residual;
    // |w|^2 = 2 KE / rho spares a product, the deformation of apply() another pass
    const double speed = density_ ? std::sqrt(2 * energy_terms.kinetic / *density_) : velocity_norm(trial_);
    record_ = {{"velocity_l2", speed}, {"displacement_strain_l2", norm(strain_gram_, deformation_)}};
    record_.insert(record_.end(), energy.terms.begin(), energy.terms.end());
    record_.emplace_back("energy_residual", energy_residual_);
    record_.insert(record_.end(), force.terms.begin(), force.terms.end());
    record_.emplace_back("force_residual", force_residual_);
}

double Momentum::velocity_norm(const std::vector<double>& w) const {
    const fem::BlockMatrix& gram = velocity_gram_ ? *velocity_gram_ : *mass_;
    return norm(gram, w) / std::sqrt(density_.value_or(1.0));
}

double Momentum::strain_norm(std::vector<double> u) const {
    centre(u, dimension_);
    return norm(strain_gram_, u);
}

double Momentum::norm(const fem::BlockMatrix& gram, const std::vector<double>& v) const {
    return std::sqrt(std::max(0.0, team_->sum(gram.quadratic_form(v))));
}

StepSeconds Momentum::seconds() const {
    StepSeconds seconds = balance_->seconds();
    seconds.audit = audit_seconds_;
    return seconds;
}

}  // namespace thermocontact::march

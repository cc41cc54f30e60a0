#include "march/momentum.h"

#include <algorithm>
#include <cmath>

#include "march/assembler.h"
#include "march/course.h"
#include "parallel/together.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

model::FacetTerm contact_term(const mesh::Mesh& mesh, const fem::Space& space, int dimension,
                              const model::ContactSurfaces& surfaces,
                              const std::vector<double>& old_displacement, std::vector<double>& velocity) {
    model::FacetTerm term(space, dimension, velocity);
    for (const auto& surface : surfaces) {
        const fem::Fields fields{{"w", {&velocity, dimension, &space.dofmap}},
                                 {"u_old", {&old_displacement, dimension, &space.dofmap}},
                                 {"g", {&surface->gap, 1, &space.dofmap}}};
        const fem::Constants constants = model::contact_constants(surface->laws, 0.0);
        if (surface->laws.compliance) {
            term.add("compliance", mesh, *surface, constants, fields);
        }
        if (surface->laws.friction) {
            term.add("friction", mesh, *surface, constants, fields);
        }
    }
    return term;
}

/// A = rho M / tau + V + tau (E + K_s).
fem::BlockMatrix system_matrix(const fem::NodeGraph& graph, int dimension, double tau,
                               const std::optional<fem::BlockMatrix>& mass,
                               const std::optional<fem::BlockMatrix>& damping,
                               const std::optional<fem::BlockMatrix>& stiffness,
                               const model::Springs& springs) {
    fem::BlockMatrix matrix = fem::zero_matrix(graph, dimension, dimension);
    if (mass) {
        matrix.add(1 / tau, *mass);
    }
    if (damping) {
        matrix.add(1, *damping);
    }
    if (stiffness) {
        matrix.add(tau, *stiffness);
    }
    springs.add_to(tau, matrix);
    return matrix;
}

/// What the scheme dissipates at one unknown, twice: `motion` is the change of the value over the step,
/// `force` that of the force, `carried` the force of y_hat less that of y (momentum_audit.h).
double twice_dissipated(const StepRule& rule, double motion, double stage, double force, double carried) {
    const double lambda = rule.tau / (rule.alpha * rule.step);
    return (2 * rule.alpha - 1) * motion * force +
           2 * stage * ((1 / lambda - 1) * force - carried / (lambda * rule.alpha));
}

}  // namespace

Momentum::Momentum(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                   const fem::NodeGraph& graph, solve::Strategy& strategy,
                   const model::ContactSurfaces& surfaces, const State& initial,
                   const std::vector<model::Source>& sources)
    : team_(&strategy.team()),
      dimension_(scene.dimension),
      mesh_(&mesh),
      surfaces_(&surfaces),
      density_(model::uniform_density(scene)),
      loads_(
          parallel::together(*team_, [&] { return model::Loads::mechanical(scene, mesh, space, sources); })),
      springs_(scene, mesh, space),
      stage_velocity_(initial.velocity),
      base_displacement_(initial.displacement),
      stage_displacement_(initial.displacement) {
    const Assembler assemble{scene, mesh, space, graph};
    const int d = dimension_;
    mass_ = assemble.when(scene.material->density.has_value(), "inertia.mass", d, d);
    damping_ = assemble.when(scene.material->viscosity.has_value(), "viscosity.damping", d, d);
    stiffness_ = assemble.when(scene.material->elasticity.has_value(), "elasticity.stiffness", d, d);
    coupling_ = assemble.when(scene.heat && scene.heat->thermal_stress, "thermal_stress.coupling", d, 1);
    velocity_gram_ = assemble.when(!density_, "norms.velocity", d, d);
    strain_gram_ = assemble("norms.strains", d, d);
    for (auto* compressible : {&mass_, &velocity_gram_}) {
        if (*compressible) {
            (*compressible)->compress();
        }
    }
    balance_ = std::make_unique<Balance>(
        "momentum", scene.solver,
        [&graph, this](double tau) {
            return system_matrix(graph, dimension_, tau, mass_, damping_, stiffness_, springs_);
        },
        model::Prescribed::displacement(scene, mesh, space),
        model::nodes_with(surfaces, space, &scene::Contact::compliance),
        contact_term(mesh, space, d, surfaces, base_displacement_, stage_velocity_), space, strategy,
        stage_velocity_);
    for (auto* nodal : {&thermal_, &inertia_, &viscous_, &compliance_, &friction_, &reaction_}) {
        nodal->resize(stage_velocity_.size());
    }
    rhs_.resize(stage_velocity_.size());
    spring_.resize(springs_.empty() ? 0 : stage_velocity_.size());
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

/// All products that the audit of a step takes.
void Momentum::apply_to_new_state() {
    now_.mass_w.resize(new_velocity_.size());
    now_.stiffness_u.resize(new_displacement_.size());
    deformation_ = new_displacement_;
    centre(deformation_, dimension_);
    balance_->beside({[this] { product(stiffness_, deformation_, now_.stiffness_u); },
                      [this] { product(damping_, stage_velocity_, viscous_); },
                      [this] { strain_square_ = strain_gram_.quadratic_form(deformation_); },
                      [this] { product(mass_, new_velocity_, now_.mass_w); }});
}

void Momentum::restart(const State& state) {
    model::set_multipliers(*surfaces_, *mesh_, state.friction_multiplier);
    apply(state.velocity, state.displacement, old_);
}

void Momentum::begin(const StepRule& rule, const State& state) {
    rule_ = rule;
    model::set_multipliers(*surfaces_, *mesh_, state.friction_multiplier);  // not those of a step that failed
    balance_->use(rule.tau);
    load_ = parallel::together(*team_, [&] { return &loads_.at(rule.stage_time()); });
    parallel::together(*team_, [&] { springs_.move(rule.begin, rule.stage_time(), rule.end); });
    extrapolate(rule.memory(), state.displacement, state.displacement_rate, base_displacement_);
    if (rule.memory() != 0) {
        extrapolate(rule.memory(), state.velocity, state.velocity_rate, base_velocity_);
        apply(base_velocity_, base_displacement_, base_);
    }
    extrapolate(rule.outlook(), state.velocity, state.velocity_rate, stage_velocity_);
    follow_course(rule, state, state.velocity, state.velocity_differences, balance_->prescribed().fixed(),
                  stage_velocity_);
    new_displacement_ = state.displacement;
    parallel::together(*team_, [&] { balance_->prescribed().apply(rule.end, new_displacement_); });
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        const double u = state.displacement[i];
        stage_displacement_[i] = u + rule.alpha * (new_displacement_[i] - u);
        stage_velocity_[i] = (stage_displacement_[i] - base_displacement_[i]) / rule.tau;
    }
}

SolveReport Momentum::solve(const std::vector<double>& temperature) {
    product(coupling_, temperature, thermal_);
    as_eigen(rhs_) = as_eigen(*load_) + as_eigen(base().mass_w) / rule_.tau - as_eigen(base().stiffness_u) +
                     as_eigen(std::as_const(thermal_));
    springs_.add_forces(-1, base_displacement_, rhs_);
    const SolveReport report = balance_->solve(rhs_);
    for (std::size_t i = 0; i < stage_displacement_.size(); ++i) {
        if (balance_->prescribed().fixed()[i] == 0) {
            stage_displacement_[i] = base_displacement_[i] + rule_.tau * stage_velocity_[i];
        }
    }
    return report;
}

void Momentum::accept(State& state, const Scheme& scheme) {
    timed(audit_seconds_, [&] {
        apply_to_new_state();
        audit(state);
    });
    renew_rates(scheme, rule_, state.displacement, new_displacement_, state.displacement_rate,
                state.displacement_curvature);
    renew_rates(scheme, rule_, state.velocity, new_velocity_, state.velocity_rate, state.velocity_curvature);
    if (balance_->starts_matter()) {
        renew_course(rule_, state, state.velocity, new_velocity_, state.velocity_differences);
    }
    std::swap(old_, now_);
    std::swap(state.displacement, new_displacement_);
    std::swap(state.velocity, new_velocity_);
    state.friction_multiplier = model::multipliers_of(*surfaces_, *mesh_);
}

/// The prescribed displacements are those of begin(), to the last bit.
void Momentum::complete(const State& state) {
    new_velocity_.resize(stage_velocity_.size());
    for (std::size_t i = 0; i < stage_velocity_.size(); ++i) {
        if (balance_->prescribed().fixed()[i] == 0) {
            new_displacement_[i] = rule_.completed(state.displacement[i], stage_displacement_[i]);
        }
        new_velocity_[i] = rule_.completed(state.velocity[i], stage_velocity_[i]);
    }
}

bool Momentum::rates_matter() const {
    return mass_ || damping_ || balance_->contact().has_friction();
}

FieldError Momentum::displacement_error(const State& state) const {
    if (!rates_matter()) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.displacement, new_displacement_,
                                         state.displacement_rate, state.displacement_curvature);
    return {estimate.empty() ? 0.0 : velocity_norm(estimate), velocity_norm(new_displacement_)};
}

FieldError Momentum::deformation_error(const State& state) const {
    if (!rates_matter() || !stiffness_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.displacement, new_displacement_,
                                         state.displacement_rate, state.displacement_curvature);
    const double kinetic = mass_ ? norm(*mass_, new_velocity_) : 0.0;
    return {estimate.empty() ? 0.0 : elastic_norm(estimate),
            std::hypot(elastic_norm(new_displacement_), kinetic)};
}

double Momentum::elastic_norm(std::vector<double> u) const {
    centre(u, dimension_);
    return norm(*stiffness_, u);
}

FieldError Momentum::velocity_error(const State& state) const {
    if (!mass_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.velocity, new_velocity_,
                                         state.velocity_rate, state.velocity_curvature);
    return {estimate.empty() ? 0.0 : velocity_norm(estimate), velocity_norm(new_velocity_)};
}

MomentumForces Momentum::collect_forces() {
    balance_->contact().nodal_forces("compliance", compliance_);
    balance_->contact().nodal_forces("friction", friction_);
    const std::vector<double>& base_mass_w = base().mass_w;
    for (std::size_t i = 0; i < inertia_.size(); ++i) {
        const double mass_change = now_.mass_w[i] - old_.mass_w[i];
        inertia_[i] = (rule_.alpha * mass_change - (base_mass_w[i] - old_.mass_w[i])) / rule_.tau;
    }
    if (!springs_.empty()) {
        std::ranges::fill(spring_, 0.0);
        springs_.add_forces(1, stage_displacement_, spring_);
    }
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        const double elastic =
            old_.stiffness_u[i] + rule_.alpha * (now_.stiffness_u[i] - old_.stiffness_u[i]);
        reaction_[i] =
            inertia_[i] + viscous_[i] + elastic - thermal_[i] + compliance_[i] + friction_[i] - (*load_)[i];
        reaction_[i] += springs_.empty() ? 0.0 : spring_[i];
    }
    const auto view = [](const std::vector<double>& v) { return as_eigen(v); };
    return {view(inertia_),  view(viscous_), view(thermal_),  view(compliance_),
            view(friction_), view(*load_),   view(reaction_), view(spring_)};
}

Energies Momentum::energies(const State& old) const {
    Energies sums;  // at shared nodes each process holds a part of M w and K u, so that the sums add up
    const Products& base = this->base();
    for (std::size_t i = 0; i < stage_velocity_.size(); ++i) {
        const double mass_change = now_.mass_w[i] - old_.mass_w[i],
                     stiffness_change = now_.stiffness_u[i] - old_.stiffness_u[i];
        const double motion = motion_of(i, old);
        sums.kinetic_old += old.velocity[i] * old_.mass_w[i];
        sums.kinetic += new_velocity_[i] * now_.mass_w[i];
        sums.kinetic_numerical +=
            twice_dissipated(rule_, new_velocity_[i] - old.velocity[i], stage_velocity_[i], mass_change,
                             base.mass_w[i] - old_.mass_w[i]);
        sums.strain_old += old.displacement[i] * old_.stiffness_u[i];
        sums.strain += new_displacement_[i] * now_.stiffness_u[i];
        sums.strain_numerical += twice_dissipated(rule_, motion, stage_displacement_[i], stiffness_change,
                                                  base.stiffness_u[i] - old_.stiffness_u[i]);
    }
    for (double Energies::*sum : {&Energies::kinetic_old, &Energies::kinetic, &Energies::kinetic_numerical,
                                  &Energies::strain_old, &Energies::strain, &Energies::strain_numerical}) {
        sums.*sum /= 2;
    }
    const model::Springs::Work work =
        springs_.work({old.displacement, stage_displacement_, new_displacement_,
                       [&](std::size_t i) { return motion_of(i, old); },
                       [&](std::size_t i) { return rule_.step * stage_velocity_[i]; }});
    sums.spring_old = work.old;
    sums.spring = work.now;
    sums.spring_numerical = work.numerical;
    sums.anchors = work.of_anchors;
    return team_->summed(sums);
}

/// u_n - u_(n-1); of a body that has moved far, the difference would have fewer digits.
double Momentum::motion_of(std::size_t i, const State& old) const {
    return (rule_.tau * stage_velocity_[i] + (base_displacement_[i] - old.displacement[i])) / rule_.alpha;
}

void Momentum::audit(const State& old) {
    const MomentumForces forces = collect_forces();
    MomentumSums sums = sum_up(forces, as_eigen(std::as_const(stage_velocity_)), dimension_);
    sums.foundation_power = balance_->contact().power_of_foundations();
    audit_.add(rule_.step, energies(old), team_->summed(sums));
}

void Momentum::close_audit(const State& state) {
    const Audit energy = audit_energy(audit_.energies, audit_.sums, audit_.duration);
    const Audit force = audit_forces(audit_.sums, dimension_);
    energy_residual_ = energy.residual;
    force_residual_ = force.residual;
    // |w|^2 = 2 KE / rho spares a product
    const double speed = std::sqrt(2 * audit_.energies.kinetic / density_.value_or(1.0));
    record_ = {{"velocity_l2", density_ ? speed : velocity_norm(state.velocity)},
               {"displacement_strain_l2", std::sqrt(std::max(0.0, team_->sum(strain_square_)))}};
    record_.insert(record_.end(), energy.terms.begin(), energy.terms.end());
    record_.emplace_back("energy_residual", energy_residual_);
    record_.insert(record_.end(), force.terms.begin(), force.terms.end());
    record_.emplace_back("force_residual", force_residual_);
    drop_audit();
}

double Momentum::velocity_norm(const std::vector<double>& w) const {
    const fem::BlockMatrix& gram = velocity_gram_ ? *velocity_gram_ : *mass_;
    return norm(gram, w) / std::sqrt(density_.value_or(1.0));
}

double Momentum::strain_norm(std::vector<double> u) const {
    centre(u, dimension_);
    return norm(strain_gram_, u);
}

double Momentum::kinetic_energy(const State& state) const {
    return mass_ ? std::pow(norm(*mass_, state.velocity), 2) / 2 : 0.0;
}

double Momentum::strain_energy(const State& state) const {
    return stiffness_ ? std::pow(elastic_norm(state.displacement), 2) / 2 : 0.0;
}

double Momentum::spring_energy(const State& state) const {
    return team_->sum(
        parallel::together(*team_, [&] { return springs_.energy(state.displacement, state.time); }));
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

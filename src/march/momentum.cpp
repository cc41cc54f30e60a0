#include "march/momentum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/both_ways.h"
#include "march/assembler.h"
#include "march/course.h"
#include "march/vectors.h"
#include "parallel/together.h"

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
      stage_displacement_(initial.displacement),
      traversal_(graph, [&strategy](int count, const std::function<void(int)>& task) {
          strategy.beside(count, task);
      }) {
    const Assembler assemble{scene, mesh, space, graph};
    const int d = dimension_;
    const scene::Material& material = *scene.material;
    const bool expands = scene.heat && scene.heat->thermal_stress;
    assemble_beside(strategy, {assemble.into(stiffness_, material.elasticity, "elasticity.stiffness", d, d),
                               assemble.into(damping_, material.viscosity, "viscosity.damping", d, d),
                               [&] {
                                   plane_ = model::plane_body(scene, mesh, space, graph);
                                   assemble.into(strain_gram_, !plane_, "norms.strains", d, d)();
                               },
                               assemble.into(coupling_, expands, "thermal_stress.coupling", d, 1),
                               assemble.into(mass_, material.density, "inertia.mass", d, d),
                               assemble.into(velocity_gram_, !density_, "norms.velocity", d, d)});
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
    for (auto* nodal : {&thermal_, &viscous_, &compliance_, &friction_, &reaction_, &rhs_, &base_velocity_,
                        &new_displacement_, &new_velocity_}) {
        nodal->resize(stage_velocity_.size());
    }
    spring_.resize(springs_.empty() ? 0 : stage_velocity_.size());
    contact_nodes_ = balance_->contact().nodes_with_forces();
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        prescribed_nodes_.push_back(dof / d);
    }
    std::ranges::sort(prescribed_nodes_);
    const auto repeated = std::ranges::unique(prescribed_nodes_);
    prescribed_nodes_.erase(repeated.begin(), repeated.end());
    restart(initial);
}

void Momentum::apply(const std::vector<double>& velocity, const std::vector<double>& displacement,
                     Products& products) {
    for (auto* nodal : {&products.mass_w, &products.stiffness_u, &products.deformation}) {
        nodal->resize(velocity.size());
    }
    centre(displacement, dimension_, traversal_, products.deformation);
    multiply({{.matrix = pointer(mass_), .x = &velocity, .y = &products.mass_w},
              {.matrix = pointer(stiffness_), .x = &products.deformation, .y = &products.stiffness_u}});
}

fem::PlaneProducts Momentum::plane_products(const std::vector<double>& velocity, Products& products) {
    return {.divergences = &plane_->divergences,
            .elasticity = plane_->elasticity,
            .viscosity = plane_->viscosity,
            .u = &products.deformation,
            .w = &velocity,
            .elastic = &products.stiffness_u,
            .viscous = &viscous_,
            .strain_square = &strain_square_};
}

/// All products that the audit of a step takes.
void Momentum::apply_to_new_state() {
    for (auto* nodal : {&now_.mass_w, &now_.stiffness_u, &now_.deformation}) {
        nodal->resize(stage_velocity_.size());
    }
    centre(new_displacement(), dimension_, traversal_, now_.deformation);
    const fem::Product mass_w{.matrix = pointer(mass_), .x = &new_velocity(), .y = &now_.mass_w};
    if (plane_) {
        const fem::PlaneProducts body = plane_products(stage_velocity_, now_);
        traversal_.run(std::array{pass_of(body), pass_of(mass_w)});
        return;
    }
    multiply({{.matrix = pointer(stiffness_), .x = &now_.deformation, .y = &now_.stiffness_u},
              {.matrix = pointer(strain_gram_), .x = &now_.deformation, .square = &strain_square_},
              {.matrix = pointer(damping_), .x = &stage_velocity_, .y = &viscous_},
              mass_w});
}

void Momentum::restart(const State& state) {
    model::set_multipliers(*surfaces_, *mesh_, state.friction_multiplier);
    apply(state.velocity, state.displacement, old_);
    if (plane_) {  // with the bits that the audit of the step before had; the other results are scratch here
        const fem::PlaneProducts body = plane_products(state.velocity, old_);
        traversal_.run(std::array{pass_of(body)});
    }
}

void Momentum::begin(const StepRule& rule, const State& state) {
    rule_ = rule;
    model::set_multipliers(*surfaces_, *mesh_, state.friction_multiplier);  // not those of a step that failed
    balance_->use(rule.tau);
    load_ = parallel::together(*team_, [&] { return &loads_.at(rule.stage_time()); });
    parallel::together(*team_, [&] { springs_.move(rule.begin, rule.stage_time(), rule.end); });
    const auto weights = course_weights(rule, state, state.past_velocity);
    traversal_.each([&](fem::NodeRange range, std::size_t) {
        const std::ptrdiff_t d = dimension_, begin = range.begin * d, end = range.end * d;
        const auto go_on = [&](double seconds, const Nodal& y, const Nodal& rate, Nodal& result) {
            extrapolate(seconds, y, rate, begin, end, result);
        };
        go_on(rule.memory(), state.displacement, state.displacement_rate, base_displacement_);
        if (rule.memory() != 0) {
            go_on(rule.memory(), state.velocity, state.velocity_rate, base_velocity_);
        }
        if (weights) {
            follow_course(*weights, state.velocity, state.past_velocity, balance_->prescribed().fixed(),
                          range, dimension_, stage_velocity_);
        } else {
            go_on(rule.outlook(), state.velocity, state.velocity_rate, stage_velocity_);
        }
    });
    if (rule.memory() != 0) {
        apply(base_velocity_, base_displacement_, base_);
    }
    parallel::together(*team_, [&] { balance_->prescribed().apply(rule.end, new_displacement_); });
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        stage_displacement_[i] = rule.staged(state.displacement[i], new_displacement_[i]);
        stage_velocity_[i] = (stage_displacement_[i] - base_displacement_[i]) / rule.tau;
    }
}

SolveReport Momentum::solve(const std::vector<double>& temperature, const StrainHeat* heat) {
    if (heat != nullptr) {
        const fem::BothWays both{pointer(coupling_), &temperature,       &thermal_,
                                 heat->factor,       heat->displacement, heat->source};
        traversal_.run(std::array{pass_of(both)});
    } else {
        multiply({{.matrix = pointer(coupling_), .x = &temperature, .y = &thermal_}});
    }
    const std::vector<double>&load = *load_, &mass_w = base().mass_w, &stiffness_u = base().stiffness_u;
    const std::vector<char>& fixed = balance_->prescribed().fixed();
    over_dofs(traversal_, dimension_, [&, tau = rule_.tau](std::size_t i) {
        rhs_[i] = load[i] + mass_w[i] / tau - stiffness_u[i] + thermal_[i];
    });
    springs_.add_forces(-1, base_displacement_, rhs_);
    const SolveReport report = balance_->solve(rhs_);
    over_dofs(traversal_, dimension_, [&, tau = rule_.tau](std::size_t i) {
        const double moved = base_displacement_[i] + tau * stage_velocity_[i];
        stage_displacement_[i] = fixed[i] == 0 ? moved : stage_displacement_[i];
    });
    return report;
}

void Momentum::accept(State& state, const Scheme& scheme) {
    audit_.add(rule_.step, step_energies_, step_sums_, step_energy_scale_);
    if (rule_.ends_at_stage()) {  // what the last system was solved for stays
        over_dofs(traversal_, dimension_, [&](std::size_t i) { new_velocity_[i] = stage_velocity_[i]; });
    }
    renew_rates(scheme, rule_, state.displacement, new_displacement(), state.displacement_rate,
                state.displacement_curvature);
    renew_rates(scheme, rule_, state.velocity, new_velocity_, state.velocity_rate, state.velocity_curvature);
    std::swap(old_, now_);
    std::swap(state.displacement, rule_.ends_at_stage() ? stage_displacement_ : new_displacement_);
    if (balance_->starts_matter()) {
        renew_course(state.past_velocity, state.velocity, new_velocity_);
    } else {
        std::swap(state.velocity, new_velocity_);
    }
    state.friction_multiplier = model::multipliers_of(*surfaces_, *mesh_);
}

/// The prescribed displacements are those of begin(), to the last bit.
void Momentum::complete(const State& state) {
    if (rule_.ends_at_stage()) {
        return;
    }
    const std::vector<char>& fixed = balance_->prescribed().fixed();
    over_dofs(traversal_, dimension_, [&, rule = rule_](std::size_t i) {
        const double u = rule.completed(state.displacement[i], stage_displacement_[i]);
        new_displacement_[i] = fixed[i] == 0 ? u : new_displacement_[i];
        new_velocity_[i] = rule.completed(state.velocity[i], stage_velocity_[i]);
    });
}

bool Momentum::rates_matter() const {
    return mass_ || damping_ || balance_->contact().has_friction();
}

FieldError Momentum::displacement_error(const State& state) const {
    if (!rates_matter()) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.displacement, new_displacement(),
                                         state.displacement_rate, state.displacement_curvature);
    return {estimate.empty() ? 0.0 : velocity_norm(estimate), velocity_norm(new_displacement())};
}

FieldError Momentum::deformation_error(const State& state) const {
    if (!rates_matter() || !stiffness_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.displacement, new_displacement(),
                                         state.displacement_rate, state.displacement_curvature);
    const double kinetic = mass_ ? norm(*mass_, new_velocity()) : 0.0;
    return {estimate.empty() ? 0.0 : elastic_norm(estimate),
            std::hypot(elastic_norm(new_displacement()), kinetic)};
}

double Momentum::elastic_norm(std::vector<double> u) const {
    centre(u, dimension_);
    return norm(*stiffness_, u);
}

FieldError Momentum::velocity_error(const State& state) const {
    if (!mass_) {
        return {};
    }
    const auto estimate = error_estimate(rule_, state.curvature_lag, state.velocity, new_velocity(),
                                         state.velocity_rate, state.velocity_curvature);
    return {estimate.empty() ? 0.0 : velocity_norm(estimate), velocity_norm(new_velocity())};
}

double Momentum::velocity_norm(const std::vector<double>& w) const {
    const fem::BlockMatrix& gram = velocity_gram_ ? *velocity_gram_ : *mass_;
    return norm(gram, w) / std::sqrt(density_.value_or(1.0));
}

double Momentum::strain_norm(std::vector<double> u) const {
    centre(u, dimension_);
    return plane_ ? norm(fem::isotropic_matrix(plane_->divergences, {0, 1}), u) : norm(*strain_gram_, u);
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

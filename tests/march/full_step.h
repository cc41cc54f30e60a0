/// One step of the scheme (MODEL.md, 3) as a full dense Newton solve: no condensation, no continuation, no
/// kept factors.
#pragma once

#include <Eigen/LU>

#include "march/state.h"
#include "model/loads.h"
#include "model/nodal.h"
#include "model/physics.h"
#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::march {

class FullStep {
  public:
    FullStep(const scene::Scene& scene, double k) : at_(scene), k_(k) {}

    /// The state at `time` from the one a step earlier.
    State operator()(const State& old, double time) {
        State now = old;
        model::update(at_.surfaces, at_.space, time);
        if (at_.scene.material) {
            solve_momentum(old, time, now);
        }
        if (at_.scene.heat) {
            solve_heat(old, time, now);
        }
        return now;
    }

  private:
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::MatrixXd;

    Matrix matrix(bool present, const std::string& form, int rows, int columns) const {
        if (!present) {
            const auto n = static_cast<Eigen::Index>(at_.node_count());
            return Matrix::Zero(rows * n, columns * n);
        }
        auto kernel = fem::find_kernel(form, at_.mesh.cell, at_.scene.degree);
        return support::dense(
            fem::assemble_matrix({std::move(kernel), at_.mesh, model::body_constants(at_.scene)}, at_.space,
                                 at_.graph, rows, columns));
    }

    struct Law {
        const model::ContactSurface* surface;
        fem::Form residual, jacobian;
    };

    void add_law(std::vector<Law>& laws, const model::ContactSurface& surface, const std::string& name,
                 double k, const fem::Fields& fields) const {
        const auto form = [&](const char* which) {
            return fem::Form(fem::find_kernel(name + which, at_.mesh.cell, at_.scene.degree), at_.mesh,
                             model::contact_constants(surface.laws, k), fields, surface.rule);
        };
        laws.push_back({&surface, form(".residual"), form(".jacobian")});
    }

    Vector forces(std::vector<Law>& laws, int components) const {
        std::vector<double> sum(at_.node_count() * components, 0.0);
        for (Law& law : laws) {
            fem::assemble_facets(law.residual, law.surface->facets, at_.space.dofmap, components, sum);
        }
        return support::as_vector(sum);
    }

    Matrix tangent(std::vector<Law>& laws, int components) const {
        const auto n = static_cast<Eigen::Index>(at_.node_count()) * components;
        Matrix sum = Matrix::Zero(n, n);
        const auto size = static_cast<std::size_t>(at_.space.dofmap.nodes_per_cell * components);
        for (Law& law : laws) {
            for (const mesh::Facet& facet : law.surface->facets) {
                std::vector<double> tensor(size * size, 0.0);
                law.jacobian.add_facet(facet, tensor);
                const auto nodes = at_.space.dofmap.of(facet.cell);
                const auto dof = [&](std::size_t i) {
                    return nodes[i / components] * components + i % components;
                };
                for (std::size_t i = 0; i < size; ++i) {
                    for (std::size_t j = 0; j < size; ++j) {
                        sum(dof(i), dof(j)) += tensor[i * size + j];
                    }
                }
            }
        }
        return sum;
    }

    /// A x + F(x) = r with the prescribed values kept, until the residual no longer falls. The forms read
    /// `x`.
    void newton(const Matrix& A, const Vector& r, std::vector<Law>& laws, int components,
                const std::vector<char>& fixed, std::vector<double>& x) const {
        const auto residual = [&] {
            Vector value = A * support::as_vector(x) + forces(laws, components) - r;
            for (std::size_t i = 0; i < fixed.size(); ++i) {
                value[i] = fixed[i] != 0 ? 0.0 : value[i];
            }
            return value;
        };
        Vector current = residual();
        for (int iteration = 0; iteration < 100 && current.norm() > 0; ++iteration) {
            Matrix J = A + tangent(laws, components);
            for (std::size_t i = 0; i < fixed.size(); ++i) {
                if (fixed[i] != 0) {
                    J.row(i).setZero();
                    J(i, i) = 1;
                }
            }
            const Vector direction = J.partialPivLu().solve(current), start = support::as_vector(x);
            double length = 1;
            Vector next;
            do {
                x = support::as_std(start - length * direction);
                next = residual();
                length /= 2;
            } while (next.norm() >= current.norm() && length > 1e-6);
            if (next.norm() >= current.norm()) {
                x = support::as_std(start);
                break;
            }
            current = next;
        }
        const double relative = current.norm() / (r.norm() + (A * support::as_vector(x)).norm());
        EXPECT_LE(relative, 1e-13) << "the full solve itself failed";
    }

    void solve_momentum(const State& old, double time, State& now) {
        const scene::Scene& scene = at_.scene;
        const Matrix M = matrix(scene.material->density.has_value(), "inertia.mass", 2, 2) / k_;
        const Matrix V = matrix(scene.material->viscosity.has_value(), "viscosity.damping", 2, 2);
        const Matrix E = matrix(scene.material->elasticity.has_value(), "elasticity.stiffness", 2, 2);
        const Vector u = support::as_vector(old.displacement), w = support::as_vector(old.velocity);
        Vector r =
            support::as_vector(model::Loads::mechanical(scene, at_.mesh, at_.space).at(time)) + M * w - E * u;
        if (scene.heat && scene.heat->thermal_stress) {
            r += matrix(true, "thermal_stress.coupling", 2, 1) * support::as_vector(old.temperature);
        }
        const auto prescribed = model::Prescribed::displacement(scene, at_.mesh, at_.space);
        prescribed.apply(time, now.displacement);
        for (const std::int32_t dof : prescribed.dofs()) {
            now.velocity[dof] = (now.displacement[dof] - old.displacement[dof]) / k_;
        }
        std::vector<Law> laws;
        for (const auto& surface : at_.surfaces) {
            const fem::Fields fields{{"w", {&now.velocity, 2, &at_.space.dofmap}},
                                     {"u_old", {&old.displacement, 2, &at_.space.dofmap}},
                                     {"v_F", surface->velocity_of_foundation(at_.space, 2)},
                                     {"g", {&surface->gap, 1, &at_.space.dofmap}}};
            if (surface->laws.compliance) {
                add_law(laws, *surface, "compliance", k_, fields);
            }
            if (surface->laws.friction) {
                add_law(laws, *surface, "friction", k_, fields);
            }
        }
        newton(M + V + k_ * E + k_ * springs(u, r, time), r, laws, 2, prescribed.fixed(), now.velocity);
        for (std::size_t i = 0; i < now.velocity.size(); ++i) {
            now.displacement[i] = old.displacement[i] + k_ * now.velocity[i];
        }
    }

    /// The matrix of k_s u; adds k_s (u_s - u) to r. By the traction of every unit vector.
    Matrix springs(const Vector& u, Vector& r, double time) const {
        const auto n = static_cast<Eigen::Index>(2 * at_.node_count());
        Matrix K = Matrix::Zero(n, n);
        for (const auto& [name, boundary] : at_.scene.boundaries) {
            if (!boundary.spring) {
                continue;
            }
            const std::vector<double>& k_s = boundary.spring->stiffness.matrix;
            std::vector<double> pull(static_cast<std::size_t>(n), 0.0);
            fem::Form form(fem::find_kernel("traction.load", at_.mesh.cell, at_.scene.degree), at_.mesh, {},
                           {{"f", {&pull, 2, &at_.space.dofmap}}});
            const auto load_of = [&](const Vector& displacement) {
                for (std::size_t i = 0; i < pull.size(); ++i) {
                    const std::size_t row = i % 2, node = i - row;
                    pull[i] = k_s[2 * row] * displacement[static_cast<Eigen::Index>(node)] +
                              k_s[2 * row + 1] * displacement[static_cast<Eigen::Index>(node + 1)];
                }
                std::vector<double> vector(pull.size(), 0.0);
                fem::assemble_facets(form, model::facets_of(at_.mesh, name), at_.space.dofmap, 2, vector);
                return Vector(support::as_vector(vector));
            };
            Matrix K_of_side(n, n);
            for (Eigen::Index dof = 0; dof < n; ++dof) {
                K_of_side.col(dof) = load_of(Vector::Unit(n, dof));
            }
            K += K_of_side;
            r +=
                load_of(support::as_vector(model::interpolate(at_.space, boundary.spring->anchor, 2, time))) -
                K_of_side * u;
        }
        return K;
    }

    void solve_heat(const State& old, double time, State& now) {
        const scene::Scene& scene = at_.scene;
        const Matrix C = matrix(scene.heat->capacity.has_value(), "heat_capacity.capacity", 1, 1) / k_;
        const Matrix K = matrix(scene.heat->conductivity.has_value(), "conduction.conduction", 1, 1);
        Vector r = support::as_vector(model::Loads::thermal(scene, at_.mesh, at_.space).at(time)) +
                   C * support::as_vector(old.temperature);
        if (scene.heat->strain_heating) {
            r += matrix(true, "strain_heating.coupling", 1, 2) * support::as_vector(old.displacement);
        }
        if (scene.heat->strain_rate_heating) {
            r += matrix(true, "strain_heating.rate_coupling", 1, 2) * support::as_vector(old.velocity);
        }
        rub(old, now, r);
        const auto prescribed = model::Prescribed::temperature(scene, at_.mesh, at_.space);
        prescribed.apply(time, now.temperature);
        const std::vector<double> at_rest(2 * at_.node_count(), 0.0);
        const std::vector<double>& u = scene.material ? now.displacement : at_rest;
        std::vector<Law> laws;
        for (const auto& surface : at_.surfaces) {
            if (surface->laws.conductance) {
                const fem::Fields fields{
                    {"theta", {&now.temperature, 1, &at_.space.dofmap}},
                    {"theta_F", {&surface->foundation_temperature, 1, &at_.space.dofmap}},
                    {"u", {&u, 2, &at_.space.dofmap}},
                    {"g", {&surface->gap, 1, &at_.space.dofmap}}};
                add_law(laws, *surface, "conductance", 0.0, fields);
            }
        }
        newton(C + K + surroundings(r, time), r, laws, 1, prescribed.fixed(), now.temperature);
    }

    /// Adds the share of what friction dissipates in the new state to r.
    void rub(const State& old, const State& now, Vector& r) const {
        std::vector<double> heat(at_.node_count(), 0.0);
        for (const auto& surface : at_.surfaces) {
            if (!surface->laws.friction) {
                continue;
            }
            const fem::Fields fields{{"w", {&now.velocity, 2, &at_.space.dofmap}},
                                     {"u_old", {&old.displacement, 2, &at_.space.dofmap}},
                                     {"v_F", surface->velocity_of_foundation(at_.space, 2)},
                                     {"g", {&surface->gap, 1, &at_.space.dofmap}}};
            fem::Form form(fem::find_kernel("friction.heat", at_.mesh.cell, at_.scene.degree), at_.mesh,
                           model::contact_constants(surface->laws, k_), fields, surface->rule);
            fem::assemble_facets(form, surface->facets, at_.space.dofmap, 1, heat);
        }
        r += support::as_vector(heat);
    }

    /// The matrix of h theta; adds h theta_a to r. By the heat flux of every unit vector.
    Matrix surroundings(Vector& r, double time) const {
        const auto n = static_cast<Eigen::Index>(at_.node_count());
        Matrix H = Matrix::Zero(n, n);
        for (const auto& [name, boundary] : at_.scene.boundaries) {
            if (!boundary.convection) {
                continue;
            }
            std::vector<double> flux(at_.node_count(), 0.0);
            fem::Form form(fem::find_kernel("heat_flux.load", at_.mesh.cell, at_.scene.degree), at_.mesh, {},
                           {{"flux", {&flux, 1, &at_.space.dofmap}}});
            const auto load = [&] {
                std::vector<double> vector(at_.node_count(), 0.0);
                fem::assemble_facets(form, model::facets_of(at_.mesh, name), at_.space.dofmap, 1, vector);
                return Vector(boundary.convection->coefficient * support::as_vector(vector));
            };
            for (std::size_t node = 0; node < flux.size(); ++node) {
                flux[node] = 1;
                H.col(static_cast<Eigen::Index>(node)) += load();
                flux[node] = 0;
            }
            flux = model::interpolate(at_.space, {&boundary.convection->ambient_temperature, 1}, 1, time);
            r += load();
        }
        return H;
    }

    support::Discretisation at_;
    double k_;
};

}  // namespace thermocontact::march

/// Closed forms of all kernels on one triangle: each entry of an element tensor as a polynomial integrand.
///
/// Written from MODEL.md in barycentric coordinates; no line is shared with forms/.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "coulomb_forms.h"
#include "situation.h"

namespace thermocontact::fem {

enum class Domain {
    cell,
    facet,    ///< exact integration
    contact,  ///< every rule of forms/space.py
    nodes     ///< the rule at the facet's nodes
};

/// Integrands of the tensor's entries, row-major, on the given facet.
using Integrands = std::function<std::vector<Polynomial>(const Situation&, std::size_t facet)>;

struct ClosedForm {
    Domain domain;
    Integrands integrands;
};

/// a^T C b with C [3][3] row-major.
inline Polynomial contract(const std::array<Polynomial, 3>& a, const std::vector<double>& C,
                           const std::array<Polynomial, 3>& b) {
    Polynomial sum;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            sum = sum + a[i] * b[j] * C[3 * i + j];
        }
    }
    return sum;
}

/// T : e with T [2][2] and the Voigt strain e.
inline Polynomial contract(const std::vector<double>& T, const std::array<Polynomial, 3>& e) {
    return e[0] * T[0] + e[1] * T[3] + e[2] * ((T[1] + T[2]) / 2);
}

inline std::array<Polynomial, 3> strain(const Triangle& triangle, const VectorPolynomial& u) {
    const VectorPolynomial x = triangle.gradient(u[0]), y = triangle.gradient(u[1]);
    return {x[0], y[1], x[1] + y[0]};
}

/// B^T C B with C = `tensor` [3][3].
inline std::vector<Polynomial> strain_product(const Situation& at, const std::vector<double>& tensor) {
    const auto shapes = vector_shapes(at);
    return outer(shapes, shapes,
                 [&](const auto& v, const auto& u) { return contract(v.strain(), tensor, u.strain()); });
}

/// grad(eta) . K grad(theta) with K [2][2].
inline std::vector<Polynomial> gradient_product(const Situation& at, const std::vector<double>& K) {
    return outer(at.shapes(), at.shapes(), [&](const auto& eta, const auto& theta) {
        const VectorPolynomial a = at.triangle.gradient(eta), b = at.triangle.gradient(theta);
        return a[0] * (b[0] * K[0] + b[1] * K[1]) + a[1] * (b[0] * K[2] + b[1] * K[3]);
    });
}

inline std::vector<Polynomial> vector_mass(const Situation& at, double factor) {
    const auto shapes = vector_shapes(at);
    return outer(shapes, shapes, [&](const auto& v, const auto& w) {
        return v.component == w.component ? v.value * w.value * factor : Polynomial();
    });
}

inline std::vector<Polynomial> scalar_mass(const Situation& at, double factor) {
    return outer(at.shapes(), at.shapes(), [&](const auto& v, const auto& u) { return v * u * factor; });
}

inline Polynomial heat_flow(const Situation& at, const Contact& contact) {
    return (contact.r * at.transfer_slope + at.transfer_offset) *
           ((at.theta - at.theta_F) * at.limited_slope + at.limited_offset);
}

inline std::vector<Polynomial> friction_jacobian(const Situation& at, std::size_t facet) {
    const Contact contact(at, facet);
    const double mu = at.constant("mu"), k = at.constant("k");
    const auto shapes = vector_shapes(at);
    return outer(shapes, shapes, [&](const auto& v, const auto& dw) {
        const double a = contact.w_t[v.component], b = contact.w_t[dw.component];
        const Polynomial bound = contact.dp * (mu * k * contact.n[dw.component] * a / contact.speed);
        const double direction = contact.tangent[v.component][dw.component] / contact.speed -
                                 a * b / (contact.speed * contact.speed * contact.speed);
        return (bound + contact.p * (mu * direction)) * v.value * dw.value;
    });
}

/// The difference of the strain of the recovered gradients and `discrete`.
inline std::array<Polynomial, 3> strain_left(const Situation& at, const std::array<Polynomial, 3>& discrete) {
    return {at.G[0][0] - discrete[0], at.G[1][1] - discrete[1], at.G[0][1] + at.G[1][0] - discrete[2]};
}

/// a . K a with K [2][2].
inline Polynomial contract(const std::vector<double>& K, const VectorPolynomial& a) {
    return a[0] * (a[0] * K[0] + a[1] * K[1]) + a[1] * (a[0] * K[2] + a[1] * K[3]);
}

/// Squares of what recovered gradients leave of the discrete ones, and of these, in the norms of energy.
inline void add_estimates(std::map<std::string, ClosedForm>& forms) {
    for (const std::string law : {"elastic", "viscous"}) {
        const std::string tensor = law == "elastic" ? "E" : "Visc";
        const auto discrete = [law](const Situation& at) {
            return strain(at.triangle, law == "elastic" ? at.u : at.w);
        };
        const auto square = [tensor](const Situation& at, const std::array<Polynomial, 3>& e) {
            return std::vector{contract(e, at.constants.at(tensor), e)};
        };
        forms["estimate." + law + "_energy"] = {
            Domain::cell, [=](const Situation& at, std::size_t) { return square(at, discrete(at)); }};
        forms["estimate." + law + "_error"] = {Domain::cell, [=](const Situation& at, std::size_t) {
                                                   return square(at, strain_left(at, discrete(at)));
                                               }};
    }
    forms["estimate.heat_energy"] = {
        Domain::cell, [](const Situation& at, std::size_t) {
            return std::vector{contract(at.constants.at("K"), at.triangle.gradient(at.theta))};
        }};
    forms["estimate.heat_error"] = {
        Domain::cell, [](const Situation& at, std::size_t) {
            const VectorPolynomial grad = at.triangle.gradient(at.theta);
            return std::vector{
                contract(at.constants.at("K"), VectorPolynomial{at.H[0] - grad[0], at.H[1] - grad[1]})};
        }};
}

/// Integral of sigma over the cell, all six components.
inline std::vector<Polynomial> stress(const Situation& at) {
    const auto e = strain(at.triangle, at.u), de = strain(at.triangle, at.w);
    const std::vector<double>&E = at.constants.at("E"), &V = at.constants.at("Visc"),
          &M = at.constants.at("M");
    const auto row = [&](const std::vector<double>& matrix, std::size_t i,
                         const std::array<Polynomial, 3>& strain) {
        return strain[0] * matrix[3 * i] + strain[1] * matrix[3 * i + 1] + strain[2] * matrix[3 * i + 2];
    };
    const auto component = [&](std::size_t i, double expansion) {
        return row(E, i, e) + row(V, i, de) - at.theta * expansion;
    };
    const Polynomial zz = row(at.constants.at("E_zz"), 0, e) + row(at.constants.at("Visc_zz"), 0, de) -
                          at.theta * at.constant("M_zz");
    return {component(0, M[0]), component(1, M[3]), zz, component(2, M[1]), 0.0, 0.0};
}

inline double von_mises(const std::vector<double>& s) {
    const double mean = (s[0] + s[1] + s[2]) / 3;
    double squares = 0;  // of the deviator
    for (std::size_t i = 0; i < 3; ++i) {
        squares += (s[i] - mean) * (s[i] - mean) + 2 * s[3 + i] * s[3 + i];
    }
    return std::sqrt(1.5 * squares);
}

inline Integrands on_contact(
    std::function<std::vector<Polynomial>(const Situation&, const Contact&)> integrands) {
    return [integrands = std::move(integrands)](const Situation& at, std::size_t facet) {
        return integrands(at, Contact(at, facet));
    };
}

inline Integrands on_cell(std::function<std::vector<Polynomial>(const Situation&)> integrands) {
    return [integrands = std::move(integrands)](const Situation& at, std::size_t) { return integrands(at); };
}

/// By the names of the kernels.
inline std::map<std::string, ClosedForm> closed_forms() {
    std::map<std::string, ClosedForm> forms;
    const auto cell = [&](const std::string& name, auto integrands) {
        forms[name] = {Domain::cell, on_cell(integrands)};
    };
    const auto contact = [&](const std::string& name, Domain domain, auto integrands) {
        forms[name] = {domain, on_contact(integrands)};
    };
    using At = const Situation&;
    using On = const Contact&;

    add_estimates(forms);
    cell("inertia.mass", [](At at) { return vector_mass(at, at.constant("rho")); });
    cell("norms.velocity", [](At at) { return vector_mass(at, 1.0); });
    cell("norms.temperature", [](At at) { return scalar_mass(at, 1.0); });
    cell("heat_capacity.capacity", [](At at) { return scalar_mass(at, at.constant("c")); });
    cell("elasticity.stiffness", [](At at) { return strain_product(at, at.constants.at("E")); });
    cell("viscosity.damping", [](At at) { return strain_product(at, at.constants.at("Visc")); });
    // eps : eps = e_xx^2 + e_yy^2 + (2 e_xy)^2 / 2
    cell("norms.strains", [](At at) { return strain_product(at, {1, 0, 0, 0, 1, 0, 0, 0, 0.5}); });
    cell("conduction.conduction", [](At at) { return gradient_product(at, at.constants.at("K")); });
    cell("norms.gradients", [](At at) { return gradient_product(at, {1, 0, 0, 1}); });
    cell("thermal_stress.coupling", [](At at) {
        return outer(vector_shapes(at), at.shapes(), [&](const auto& v, const auto& theta) {
            return theta * contract(at.constants.at("M"), v.strain());
        });
    });
    cell("strain_heating.coupling", [](At at) {
        return outer(at.shapes(), vector_shapes(at), [&](const auto& eta, const auto& u) {
            return eta * contract(at.constants.at("R"), u.strain());
        });
    });
    cell("strain_heating.rate_coupling", [](At at) {
        return outer(at.shapes(), vector_shapes(at), [&](const auto& eta, const auto& u) {
            return eta * contract(at.constants.at("R_rate"), u.strain());
        });
    });
    cell("body_force.load", vector_load);
    cell("heat_source.load", [](At at) { return scalar_load(at, at.theta); });
    cell("stress.integrated", stress);
    cell("stress.volume", [](At) { return std::vector<Polynomial>{1.0}; });
    cell("stress.von_mises", [](At at) { return std::vector<Polynomial>{von_mises(at.stress)}; });
    forms["traction.load"] = {Domain::facet, on_cell(vector_load)};
    forms["norms.velocity_trace"] = {Domain::facet, on_cell([](At at) { return vector_mass(at, 1.0); })};
    forms["norms.temperature_trace"] = {Domain::facet, on_cell([](At at) { return scalar_mass(at, 1.0); })};
    forms["heat_flux.load"] = {Domain::facet, on_cell([](At at) { return scalar_load(at, at.theta); })};

    forms["spring.stiffness"] = {Domain::facet, on_cell([](At at) {
                                     const auto shapes = vector_shapes(at);
                                     return outer(shapes, shapes, [&](const auto& v, const auto& u) {
                                         const double k_s =
                                             at.constants.at("k_s")[2 * v.component + u.component];
                                         return v.value * u.value * k_s;
                                     });
                                 })};
    forms["convection.exchange"] = {Domain::facet,
                                    on_cell([](At at) { return scalar_mass(at, at.constant("h")); })};
    forms["convection.ambient"] = {
        Domain::facet, on_cell([](At at) { return scalar_load(at, at.theta * at.constant("h")); })};

    contact("compliance.residual", Domain::contact, [](At at, On on) {
        return each(vector_shapes(at), [&](const auto& v) { return on.p * v.dot(on.n); });
    });
    contact("compliance.jacobian", Domain::contact, [](At at, On on) {
        const auto shapes = vector_shapes(at);
        return outer(shapes, shapes, [&](const auto& v, const auto& dw) {
            return on.dp * at.constant("k") * dw.dot(on.n) * v.dot(on.n);
        });
    });
    contact("compliance.normal_force", Domain::contact,
            [](At, On on) { return std::vector<Polynomial>{on.p}; });
    contact("compliance.pressure", Domain::nodes, [](At at, On on) { return scalar_load(at, on.p); });
    contact("friction.residual", Domain::contact, [](At at, On on) {
        return each(vector_shapes(at),
                    [&](const auto& v) { return on.p * (at.constant("mu") / on.speed) * v.dot(on.w_t); });
    });
    forms["friction.jacobian"] = {Domain::contact, friction_jacobian};
    contact("friction.traction", Domain::nodes, [](At at, On on) {
        return each(vector_shapes(at),
                    [&](const auto& v) { return on.p * (-at.constant("mu") / on.speed) * v.dot(on.w_t); });
    });
    contact("friction.heat", Domain::contact, [](At at, On on) {
        const double slip_squared = on.w_t[0] * on.w_t[0] + on.w_t[1] * on.w_t[1];
        const double factor = at.constant("heat_share") * at.constant("mu") * slip_squared / on.speed;
        return scalar_load(at, on.p * factor);
    });
    contact("coulomb.heat", Domain::contact, projected_heat);
    contact("coulomb.residual", Domain::contact, projected_load);
    contact("coulomb.jacobian", Domain::contact, projected_jacobian);
    contact("coulomb.functional", Domain::contact, projected_functional);
    contact("coulomb.gram", Domain::contact, multiplier_gram);
    contact("coulomb.slip_area", Domain::contact, [](At at, On on) {
        return std::vector<Polynomial>{at.closed && Projection(at, on).slips ? 1.0 : 0.0};
    });
    contact("coulomb.slips", Domain::nodes,
            [](At at, On on) { return scalar_load(at, Projection(at, on).slips ? 1.0 : 0.0); });
    contact("coulomb.force", Domain::contact, [](At at, On on) { return coulomb_load(at, on, true); });
    contact("coulomb.traction", Domain::nodes, [](At at, On on) {
        return each(coulomb_load(at, on, false), [](const auto& load) { return load * -1.0; });
    });
    contact("conductance.residual", Domain::contact,
            [](At at, On on) { return scalar_load(at, heat_flow(at, on)); });
    contact("conductance.heat_flow", Domain::nodes,
            [](At at, On on) { return scalar_load(at, heat_flow(at, on)); });
    contact("conductance.jacobian", Domain::contact, [](At at, On on) {
        const Polynomial slope = (on.r * at.transfer_slope + at.transfer_offset) * at.limited_slope;
        return outer(at.shapes(), at.shapes(), [&](const auto& v, const auto& u) { return v * u * slope; });
    });
    contact("kinematics.area", Domain::contact, [](At, On) { return std::vector<Polynomial>{1.0}; });
    contact("kinematics.closed_area", Domain::contact,
            [](At at, On) { return std::vector<Polynomial>{at.closed ? 1.0 : 0.0}; });
    contact("kinematics.slip_area", Domain::contact, [](At at, On on) {
        return std::vector<Polynomial>{at.closed && on.slips(at.constant("eps")) ? 1.0 : 0.0};
    });
    contact("kinematics.node_area", Domain::nodes, [](At at, On) { return at.shapes(); });
    contact("kinematics.gap", Domain::nodes, [](At at, On on) { return scalar_load(at, 0.0 - on.r); });
    contact("kinematics.slip_velocity", Domain::nodes, [](At at, On on) {
        return each(vector_shapes(at), [&](const auto& v) { return v.dot(on.w_t); });
    });
    return forms;
}

}  // namespace thermocontact::fem

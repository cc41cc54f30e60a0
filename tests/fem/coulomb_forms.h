/// Closed forms of the kernels of Coulomb's law by projection (forms/coulomb.py), where multiplier, slip
/// velocity and with them t = lam + gamma w_t are constant.
#pragma once

#include "situation.h"

namespace thermocontact::fem {

struct Projection {
    Vector2 t;
    double size;  ///< |t|
    bool slips;   ///< gamma |w_t| beyond a millionth of mu p_n: in these situations, moving

    Projection(const Situation& at, const Contact& on)
        : t{at.multiplier[0] + at.constant("gamma") * on.w_t[0],
            at.multiplier[1] + at.constant("gamma") * on.w_t[1]},
          size(std::hypot(t[0], t[1])),
          slips(on.w_t[0] != 0 || on.w_t[1] != 0) {}
};

/// v_t . (a, b) of a shape function.
inline Polynomial tangential_dot(const VectorShape& v, const Contact& on, const Vector2& a) {
    return v.value * (on.tangent[v.component][0] * a[0] + on.tangent[v.component][1] * a[1]);
}

/// -sigma_t . v_t for the multiplier `lam` + gamma w_t.
inline std::vector<Polynomial> projected_load(const Situation& at, const Contact& on) {
    const Projection to(at, on);
    return each(vector_shapes(at), [&](const auto& v) {
        const Polynomial along = tangential_dot(v, on, to.t);
        return at.held ? along : on.p * (at.constant("mu") / to.size) * along;
    });
}

/// share * -sigma_t . w_t.
inline std::vector<Polynomial> projected_heat(const Situation& at, const Contact& on) {
    const Projection to(at, on);
    const double power = at.constant("heat_share") * (to.t[0] * on.w_t[0] + to.t[1] * on.w_t[1]);
    return scalar_load(at, at.held ? Polynomial(power) : on.p * (at.constant("mu") * power / to.size));
}

inline std::vector<Polynomial> projected_jacobian(const Situation& at, const Contact& on) {
    const Projection to(at, on);
    const double mu = at.constant("mu"), k = at.constant("k"), gamma = at.constant("gamma");
    const auto shapes = vector_shapes(at);
    return outer(shapes, shapes, [&](const auto& v, const auto& dw) {
        const auto a = v.component, b = dw.component;
        if (at.held) {
            return v.value * dw.value * (gamma * on.tangent[a][b]);
        }
        const Vector2 unit{to.t[0] / to.size, to.t[1] / to.size};
        double v_t = 0, dw_t = 0, both = 0;  // v_t . unit, dw_t . unit, v_t . dw_t
        for (std::size_t c = 0; c < 2; ++c) {
            v_t += on.tangent[a][c] * unit[c];
            dw_t += on.tangent[b][c] * unit[c];
            both += on.tangent[a][c] * on.tangent[b][c];
        }
        return (on.dp * (mu * k * on.n[b] * v_t) + on.p * (mu * gamma / to.size * (both - v_t * dw_t))) *
               v.value * dw.value;
    });
}

/// -sigma_t of the state at hand: mu p_n w_t/|w_t| where it slips, else the multiplier's projection.
inline std::vector<Polynomial> coulomb_load(const Situation& at, const Contact& on, bool tangential) {
    const double mu = at.constant("mu"), speed = std::hypot(on.w_t[0], on.w_t[1]);
    const double size = std::hypot(at.multiplier[0], at.multiplier[1]);
    const bool slips = Projection(at, on).slips;
    const Vector2& along = slips ? on.w_t : at.multiplier;
    return each(vector_shapes(at), [&](const auto& v) {
        const Polynomial shape = tangential ? tangential_dot(v, on, along) : v.dot(along);
        return slips ? on.p * (mu / speed) * shape : at.held ? shape : on.p * (mu / size) * shape;
    });
}

/// Against all functions of degree 2, of which the multiplier is one.
inline std::vector<Polynomial> projected_functional(const Situation& at, const Contact& on) {
    const Projection to(at, on);
    std::vector<Polynomial> result;
    for (const Polynomial& psi : support::shape_functions(2)) {
        for (const double t : to.t) {
            result.push_back(at.held ? psi * t : on.p * psi * (at.constant("mu") * t / to.size));
        }
    }
    return result;
}

inline std::vector<Polynomial> multiplier_gram(const Situation&, const Contact&) {
    const auto shapes = support::shape_functions(2);
    return outer(shapes, shapes, [](const auto& chi, const auto& dchi) { return chi * dchi; });
}

}  // namespace thermocontact::fem

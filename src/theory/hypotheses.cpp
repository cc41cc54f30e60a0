#include "theory/hypotheses.h"

#include <cmath>

#include "model/physics.h"
#include "theory/law_bounds.h"
#include "theory/tensor_bounds.h"

namespace thermocontact::theory {
namespace {

Verdict verdict(bool holds) {
    return holds ? Verdict::holds : Verdict::fails;
}

class Judge {
  public:
    Judge(const scene::Scene& scene, const std::vector<Piece>& pieces, const Constants& constants,
          const Samples& samples)
        : scene_(scene),
          pieces_(pieces),
          constants_(constants),
          samples_(samples),
          laws_(bounds_of_laws(scene)) {}

    std::vector<Condition> conditions() {
        problem();
        inequalities();
        mechanical_tensors();
        conductivity();
        coupling("(H4", "M", "thermal stress", &scene::Heat::thermal_stress);
        coupling("(H5", "R", "strain heating", &scene::Heat::strain_heating);
        loads();
        gap_and_initial_data();
        heat_exchange();
        contact_laws();
        coercivity();
        return std::move(conditions_);
    }

  private:
    void add(const std::string& label, bool holds, const std::string& statement,
             std::vector<Number> numbers = {}) {
        conditions_.push_back({label, verdict(holds), statement, std::move(numbers)});
    }
    void skip(const std::string& label, const std::string& reason) {
        conditions_.push_back({label, Verdict::not_applicable, reason, {}});
    }

    /// Problem 2.1 has both balances with their rates, and vanishing prescribed values.
    void problem() {
        rate("(2.3)", "inertia", "rho", &Piece::material, &scene::Material::density);
        rate("(2.4)", "heat capacity", "c", &Piece::heat, &scene::Heat::capacity);
        if (scene_.material) {
            values_vanish("(2.5)", "displacement prescribed as 0", "max |u_D|", samples_.clamp);
        }
        if (scene_.heat) {
            values_vanish("(2.7)", "temperature prescribed as 0", "max |theta_D|",
                          samples_.prescribed_temperature);
        }
        if (model::has_spring(scene_)) {
            add("(2.6)", false,
                "tractions prescribed (springs hold sides: k_s u adds to the operator of (H2), monotone "
                "and Lipschitz, and to r_a)");
        }
    }

    template <typename Body>
    void rate(const std::string& label, const std::string& statement, const std::string& name,
              std::optional<Body> Piece::*body, std::optional<double> Body::*density) {
        const auto [value, where] = smallest(pieces_, [&](const Piece& piece) {
            return piece.*body ? ((*(piece.*body)).*density).value_or(0) : 0.0;
        });
        add(label, value > 0, statement + (value > 0 ? "" : " (not modelled)"), {{name, value, where}});
    }

    void values_vanish(const std::string& label, const std::string& statement, const std::string& name,
                       const Range& range) {
        add(label, range.finite() && range.magnitude() == 0, statement + explain(range),
            {{name, range.magnitude()}});
    }

    static std::string explain(const Range& range) {
        return range.finite() ? "" : " (" + range.failure + ")";
    }

    void inequalities() {
        if (constants_.c_k) {
            add("(2.12)", *constants_.c_k > 0, "Korn: the clamped sides hold the body",
                {{"c_k", *constants_.c_k}});
        }
        if (constants_.c_f) {
            add("(2.13)", *constants_.c_f > 0, "Friedrichs-Poincare: the temperature is prescribed somewhere",
                {{"c_f", *constants_.c_f}});
        }
    }

    void mechanical_tensors() {
        if (!scene_.material) {
            skip("(H1), (H2)", "no [material]");
            return;
        }
        tensor4("(H1", "viscosity", "b", &scene::Material::viscosity, &Piece::viscosity);
        m_a_ = tensor4("(H2", "elasticity", "a", &scene::Material::elasticity, &Piece::elasticity);
    }

    /// Returns m.
    Number tensor4(const std::string& label, const std::string& name, const std::string& index,
                   std::optional<scene::VoigtTensor> scene::Material::*member,
                   std::optional<Bounds> Piece::*bounds) {
        if (!((*scene_.material).*member)) {
            add(label + " i)", false, name + " elliptic (none is modelled)", {{"m_" + index, 0}});
            return {"m_" + index, 0};
        }
        const auto [m, where_m] =
            smallest(pieces_, [&](const Piece& piece) { return (*(piece.*bounds)).smallest; });
        const auto [M, where_M] =
            largest(pieces_, [&](const Piece& piece) { return (*(piece.*bounds)).largest; });
        const bool own = (*((*scene_.material).*member)).own.has_value();
        const std::string sampled = own ? " at the points of its rule" : "";
        const std::string constant = own                   ? " of a law file symmetric"
                                     : pieces_.size() == 1 ? " constant in space"
                                                           : " constant in each region";
        add(label + " i)", m > 0, name + " elliptic" + sampled, {{"m_" + index, m, where_m}});
        add(label + " ii)", true, name + " bounded" + sampled, {{"M_" + index, M, where_M}});
        add(label + " iii, iv)", true, name + constant + " and linear");
        return {"m_" + index, m, where_m};
    }

    void conductivity() {
        if (!scene_.heat) {
            skip("(H3)", "no [heat]");
            return;
        }
        const auto bounds = [](const Piece& piece) {
            return piece.heat->conductivity ? bounds_of(*piece.heat->conductivity) : Bounds{};
        };
        const auto [m, where_m] =
            smallest(pieces_, [&](const Piece& piece) { return bounds(piece).smallest; });
        const auto [M, where_M] = largest(pieces_, [&](const Piece& piece) { return bounds(piece).largest; });
        m_d_ = {"m_d", m, where_m};
        const char* why = !scene_.heat->conductivity ? " (none is modelled)"
                          : m > 0                    ? ""
                                                     : " (heat does not diffuse in every direction)";
        add("(H3 i)", true, "conductivity symmetric and bounded");
        add("(H3 ii)", m > 0, std::string("conductivity elliptic") + why, {m_d_});
        add("(H3 iii)", true, "conductivity bounded", {{"M_d", M, where_M}});
    }

    /// |(T theta, eps(v))| <= |T| ||theta|| ||eps(v)|| <= |T| / c_f ||theta||_Q ||v||_V.
    void coupling(const std::string& label, const std::string& letter, const std::string& name,
                  std::optional<scene::SymmetricTensor> scene::Heat::*member) {
        if (!scene_.heat || !((*scene_.heat).*member)) {
            skip(label + ")", "no " + name);
            return;
        }
        const auto [norm, where] =
            largest(pieces_, [&](const Piece& piece) { return norm_of(*((*piece.heat).*member)); });
        const double bound = norm == 0 ? 0.0 : norm / constants_.c_f.value_or(0);
        add(label + " i)", true, name + " symmetric and bounded", {{"|" + letter + "|", norm, where}});
        add(label + " ii)", std::isfinite(bound), name + " bounded from Q and V",
            {{"|" + letter + "| / c_f", bound}});
    }

    void loads() {
        const std::vector<std::pair<const char*, const Range*>> kinds{
            {"max |f0|", &samples_.body_force},
            {"max |f1|", &samples_.traction},
            {"max |u_s|", &samples_.anchor},
            {"max |q0|", &samples_.heat_source},
            {"max |heat flux|", &samples_.heat_flux}};
        bool finite = true;
        std::string why;
        std::vector<Number> numbers;
        for (const auto& [name, range] : kinds) {
            finite = finite && range->finite();
            why += explain(*range);
            if (range->present()) {
                numbers.push_back({name, range->magnitude()});
            }
        }
        add("(H6 i)", finite, (numbers.empty() ? "no loads" : "loads finite where sampled") + why, numbers);
    }

    void gap_and_initial_data() {
        if (samples_.gap.present()) {
            add("(H6 ii)", samples_.gap.finite() && samples_.gap.smallest >= 0,
                "gap not negative" + explain(samples_.gap), {{"min g", samples_.gap.smallest}});
        } else {
            skip("(H6 ii)", "no contact: no gap");
        }
        if (const Range& theta_F = samples_.foundation_temperature; theta_F.present()) {
            add("(H6 ii)", theta_F.finite(), "foundation temperature finite" + explain(theta_F),
                {{"max |theta_F|", theta_F.magnitude()}});
        }
        if (scene_.material) {
            values_vanish("(H6 ii)", "initial displacement and velocity in V", "max |u0|, |u0'| on Gamma_D",
                          samples_.initial_on_clamp);
        }
        if (model::has_compliance(scene_)) {
            add("(H6 iii)", true, "j convex and lower semi-continuous: p_tau not negative");
        } else {
            skip("(H6 iii)", "no compliance: no functional j");
        }
    }

    void heat_exchange() {
        if (!model::has_conductance(scene_)) {
            skip("(H7)", "no conductance");
            return;
        }
        if (laws_.own_exchange) {
            skip("(H7)", "conductance of a law file is not judged");
            return;
        }
        add("(H7 i)", true, "k_c bounded, zero without contact; any M_kc above", {{"sup k_c", laws_.M_kc}});
        add("(H7 ii)", true, "k_c Lipschitz", {{"L_kc", laws_.L_kc}});
    }

    void contact_laws() {
        if (!model::has_compliance(scene_)) {
            skip("(H8)", "no compliance");
            return;
        }
        if (laws_.own_contact) {
            skip("(H8)", "compliance or friction of a law file is not judged");
            return;
        }
        add("(H8 i-iii)", true, "p_nu and p_tau not negative, zero without contact");
        const std::string why =
            laws_.not_lipschitz.empty() ? "" : " (not with the exponent on " + laws_.not_lipschitz + ")";
        add("(H8 iv)", laws_.not_lipschitz.empty(), "p_nu and p_tau Lipschitz" + why,
            {{"L_nu", laws_.L_nu}, {"L_tau", laws_.L_tau}});
    }

    /// (2.23) as README's errata read it.
    void coercivity() {
        if (laws_.own_contact) {
            skip("(2.23)", "m_a > (L_nu + L_tau) s1^2: the law of a file is not judged");
        } else if (constants_.s1) {
            exceeds("m_a > (L_nu + L_tau) s1^2", m_a_,
                    {"(L_nu + L_tau) s1^2", product(laws_.L_nu + laws_.L_tau, *constants_.s1)});
            operators("E and the laws", "r_a", constants_.r_a, "(H2 i)");
        } else {
            skip("(2.23)", "m_a > (L_nu + L_tau) s1^2: no compliance");
        }
        if (laws_.own_exchange) {
            skip("(2.23)", "m_d > M_kc s2^2: the law of a file is not judged");
        } else if (constants_.s2) {
            exceeds("m_d > M_kc s2^2", m_d_, {"M_kc s2^2", product(laws_.M_kc, *constants_.s2)});
            operators("K and the laws", "r_d", constants_.r_d, "(H3 ii)");
        } else {
            skip("(2.23)", "m_d > M_kc s2^2: no conductance");
        }
    }

    void exceeds(const std::string& statement, const Number& left, const Number& right) {
        add("(2.23)", left.value > right.value, statement, {left, right});
    }

    /// What (2.23) is there for, without the worst case of each factor: see constants.h.
    void operators(const std::string& what, const std::string& name, const std::optional<double>& quotient,
                   const std::string& needed) {
        if (quotient) {
            add("(2.23 op)", *quotient < 1, name + " < 1, " + what + " weighed as they are",
                {{name, *quotient}});
        } else {
            add("(2.23 op)", false, name + " < 1, " + what + " weighed as they are: needs " + needed);
        }
    }

    /// factor * s^2, where a law that is zero needs no trace inequality.
    static double product(double factor, double s) { return factor == 0 ? 0.0 : factor * s * s; }

    const scene::Scene& scene_;
    const std::vector<Piece>& pieces_;
    const Constants& constants_;
    const Samples& samples_;
    LawBounds laws_;
    Number m_a_{"m_a", 0}, m_d_{"m_d", 0};
    std::vector<Condition> conditions_;
};

}  // namespace

std::vector<Condition> judge(const scene::Scene& scene, const std::vector<Piece>& pieces,
                             const Constants& constants, const Samples& samples) {
    return Judge(scene, pieces, constants, samples).conditions();
}

}  // namespace thermocontact::theory

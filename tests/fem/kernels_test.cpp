#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "closed_forms.h"
#include "fem/kernel_table.h"

namespace thermocontact::fem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One triangle of each orientation, and a thin one.
const std::vector<Triangle> triangles{{{{{0, 0}, {1, 0}, {0, 1}}}},
                                      {{{{0.2, -0.1}, {0.5, 1.3}, {1.7, 0.4}}}},
                                      {{{{-1, 2}, {-0.9, 2.0}, {-0.95, 3.1}}}}};

/// sum a_i l_i, and for degree 2 a product as well.
Polynomial field(int degree, double a, double b, double c) {
    const auto l = [](std::size_t i) { return Polynomial::coordinate(i); };
    const Polynomial linear = a * l(0) + b * l(1) + c * l(2);
    return degree == 1 ? linear : linear + (a - 2 * b) * l(0) * l(1) + (b + c) * l(1) * l(2);
}

Constants constants() {
    return {{"rho", {1.7}},
            {"c", {2.3}},
            {"E", {6, 2, 0.4, 2, 4, -0.3, 0.4, -0.3, 1.5}},
            {"Visc", {1.2, 0.2, 0.05, 0.2, 0.8, 0.1, 0.05, 0.1, 0.3}},
            {"E_zz", {0.7, 0.9, 0.2}},
            {"Visc_zz", {0.3, 0.1, -0.4}},
            {"K", {1, 0.25, 0.25, 0.6}},
            {"M", {0.3, 0.1, 0.1, 0.2}},
            {"M_zz", {0.45}},
            {"R", {0.4, -0.1, -0.1, 0.3}},
            {"R_rate", {-0.2, 0.3, 0.3, 0.5}},
            {"h", {3.1}},
            {"k_s", {2.0, -0.7, -0.7, 1.5}},
            {"heat_share", {0.6}},
            {"c_n", {40}},
            {"m", {1}},
            {"mu", {0.3}},
            {"eps", {0.15}},
            {"gamma", {2}},
            {"k", {0.05}},
            {"k_c", {2}},
            {"eps_c", {10}},
            {"L", {infinity}}};
}

/// General fields, for the forms of the body and the loads.
Situation body(const Triangle& triangle, int degree) {
    Situation at{
        "body", triangle, degree, constants(), {}, {}, {}, {}, {}, {}, {1.2, -0.7, 0.4, 0.3, -0.2, 0.6}};
    at.u = {field(degree, 0.1, -0.2, 0.3), field(degree, 0.4, 0.1, -0.1)};
    at.w = {field(degree, -0.3, 0.6, 0.2), field(degree, 0.7, -0.5, 0.4)};
    at.f = {field(degree, 1.0, 2.0, -1.0), field(degree, -0.5, 0.3, 2.5)};
    at.theta = field(degree, 2.0, -1.0, 0.5);
    at.G = {VectorPolynomial{field(degree, 0.4, -0.1, 0.2), field(degree, 0.1, 0.3, -0.2)},
            VectorPolynomial{field(degree, -0.3, 0.5, 0.1), field(degree, 0.2, -0.4, 0.6)}};
    at.H = {field(degree, 1.2, 0.7, -0.3), field(degree, -0.5, 0.2, 0.9)};
    return at;
}

/// Penetration 0.4 to 0.6 on all facets; k_c(r) on its slope; |theta - theta_F| < L.
Situation contact(const std::string& name, const Triangle& triangle, int degree) {
    Situation at = body(triangle, degree);
    at.name = name;
    at.u = {field(1, 0.03, -0.02, 0.05), field(1, -0.04, 0.01, 0.02)};
    at.w = {Polynomial(0.3), Polynomial(-0.2)};
    at.g = field(1, -0.5, -0.52, -0.47);
    at.theta = field(degree, 0.5, 0.3, 0.4);
    at.theta_F = field(degree, 0.1, 0.2, -0.3);
    at.transfer_slope = at.constant("k_c") / at.constant("eps_c");
    return at;
}

std::vector<Situation> contact_situations(const Triangle& triangle, int degree) {
    std::vector<Situation> result;
    const auto add = [&](const std::string& name, auto change) {
        result.push_back(contact(name, triangle, degree));
        change(result.back());
    };
    const auto limited = [](Situation& at, double theta) {
        at.constants["L"] = {1.0};
        at.theta = field(at.degree, theta, 1.1 * theta, 0.9 * theta);
        at.limited_slope = 0;
        at.limited_offset = theta > 0 ? 1.0 : -1.0;
    };
    add("closed", [](Situation&) {});
    add("squared law", [](Situation& at) { at.constants["m"] = {2.0}; });
    add("open", [](Situation& at) {
        at.g = field(1, 0.5, 0.6, 0.7);
        at.closed = false;
        at.transfer_slope = 0;
    });
    add("touching at rest", [](Situation& at) { at.u = at.w = {}, at.g = Polynomial(), at.foundation = {}; });
    add("sliding slower than epsilon", [](Situation& at) { at.constants["eps"] = {3.0}; });
    add("frictionless epsilon", [](Situation& at) { at.constants["eps"] = {-1.0}; });
    add("held while it moves", [](Situation& at) {
        at.multiplier = {0.5, 0.3};
        at.held = true;
    });
    add("held at rest", [](Situation& at) {
        at.w = {Polynomial(at.foundation[0]), Polynomial(at.foundation[1])};
        at.multiplier = {0.5, 0.3};
        at.held = true;
    });
    add("full conductance", [](Situation& at) {
        at.constants["eps_c"] = {0.01};
        at.transfer_slope = 0;
        at.transfer_offset = at.constant("k_c");
    });
    add("finite limit, not reached", [](Situation& at) { at.constants["L"] = {50.0}; });
    add("hot body beyond the limit", [&](Situation& at) { limited(at, 7.0); });
    add("cold body beyond the limit", [&](Situation& at) { limited(at, -7.0); });
    return result;
}

/// Nodal values of the fields of a situation, bound to a mesh of its triangle.
class OneElement {
  public:
    explicit OneElement(const Situation& at)
        : mesh_(at.triangle.mesh()),
          space_(make_space(mesh_, at.degree)),
          quadratic_(make_space(mesh_, 2)),
          at_(at) {
        const double k = at.constant("k");
        const VectorPolynomial u_old{at.u[0] - k * at.w[0], at.u[1] - k * at.w[1]};
        add("u", {at.u[0], at.u[1]});
        add("u_old", {u_old[0], u_old[1]});
        add("w", {at.w[0], at.w[1]});
        add("f", {at.f[0], at.f[1]});
        add("g", {at.g});
        add("G0", {at.G[0][0], at.G[0][1]});
        add("G1", {at.G[1][0], at.G[1][1]});
        add("H", {at.H[0], at.H[1]});
        add("theta_F", {at.theta_F});
        add("v_F", {Polynomial(at.foundation[0]), Polynomial(at.foundation[1])});
        for (const char* name : {"theta", "theta_a", "q0", "flux"}) {
            add(name, {at.theta});
        }
        for (std::size_t node = 0; node < quadratic_.nodes.size(); ++node) {
            values_["lam"].insert(values_["lam"].end(), at.multiplier.begin(), at.multiplier.end());
        }
        fields_["lam"] = {&values_["lam"], 2, &quadratic_.dofmap};
        values_["s"] = at.stress;
        fields_["s"] = {&values_["s"], 6, &space_.cellwise};
    }
    OneElement(const OneElement&) = delete;
    OneElement& operator=(const OneElement&) = delete;

    std::vector<double> cell(const std::string& kernel, std::size_t size) {
        std::vector<double> tensor(size, 0.0);
        form(kernel, -1).add_cell(0, tensor);
        return tensor;
    }

    std::vector<double> facet(const std::string& kernel, std::size_t facet, int rule, std::size_t size) {
        std::vector<double> tensor(size, 0.0);
        form(kernel, rule).add_facet(mesh_.facets[facet], tensor);
        return tensor;
    }

  private:
    Form form(const std::string& kernel, int rule) const {
        return {find_kernel(kernel, "triangle", at_.degree), mesh_, at_.constants, fields_, rule};
    }
    void add(const std::string& name, const std::vector<Polynomial>& components) {
        for (const auto& node : support::node_coordinates(at_.degree)) {
            for (const Polynomial& component : components) {
                values_[name].push_back(component(node));
            }
        }
        fields_[name] = {&values_[name], static_cast<int>(components.size()), &space_.dofmap};
    }

    mesh::Mesh mesh_;
    Space space_, quadratic_;
    const Situation& at_;
    std::map<std::string, std::vector<double>> values_;
    Fields fields_;
};

/// Gauss points and weights on (-1, 1), by the degree to which they are exact.
const std::map<int, std::vector<std::pair<double, double>>> gauss{
    {1, {{0, 2}}},
    {3, {{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}}},
    {5, {{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}}};

/// What the named rule of forms/space.py makes of a polynomial on a facet.
double quadrature(const Polynomial& p, const Triangle& triangle, int degree, std::size_t facet, int rule) {
    const double length = triangle.facet_length(facet);
    const auto at = [&](double s) {
        std::array<double, 3> l{};
        l[(facet + 1) % 3] = 1 - s;
        l[(facet + 2) % 3] = s;
        return p(l);
    };
    if (rule == 0) {
        return degree == 1 ? length * (at(0) + at(1)) / 2 : length * (at(0) + 4 * at(0.5) + at(1)) / 6;
    }
    if (rule > 5) {
        return p.over_facet(facet, length);  // the integrands have degree 6 at most
    }
    double sum = 0;
    for (const auto& [point, weight] : gauss.at(rule)) {
        sum += weight * at(0.5 + point / 2) / 2;
    }
    return length * sum;
}

/// An entry is a sum of up to 50 products (points, components, columns of B) with table values and weights
/// good to machine precision; each rounding is relative to a summand, and the summands exceed the largest
/// entry tenfold at most. Integrands that vanish must give exact zeros.
void expect_equal(const std::vector<double>& found, const std::vector<double>& expected) {
    double largest = 0;
    for (const double value : expected) {
        largest = std::max(largest, std::abs(value));
    }
    const double tolerance = 500 * std::numeric_limits<double>::epsilon() * largest;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], tolerance) << "entry " << i;
    }
}

struct Named {
    std::string kernel;
    int degree;
};

std::vector<Named> kernels_of(const std::string& cell) {
    std::vector<Named> result;
    for (int i = 0; i < thermocontact_kernel_count; ++i) {
        if (thermocontact_kernels[i].cell == cell) {
            result.push_back({thermocontact_kernels[i].name, thermocontact_kernels[i].degree});
        }
    }
    return result;
}

class Kernels : public testing::TestWithParam<Named> {
  protected:
    static void check(const ClosedForm& form, const Situation& at, std::size_t facet, int rule) {
        std::vector<double> expected;
        for (const Polynomial& p : form.integrands(at, facet)) {
            expected.push_back(form.domain == Domain::cell
                                   ? p.over_triangle(at.triangle.area())
                                   : quadrature(p, at.triangle, at.degree, facet, rule));
        }
        OneElement element(at);
        const std::string& name = GetParam().kernel;
        // forms with one integral everywhere have no rules to choose from
        const int asked = form.domain == Domain::contact ? rule : -1;
        expect_equal(form.domain == Domain::cell ? element.cell(name, expected.size())
                                                 : element.facet(name, facet, asked, expected.size()),
                     expected);
    }
};

TEST_P(Kernels, EqualTheirClosedForms) {
    const auto forms = closed_forms();
    ASSERT_TRUE(forms.contains(GetParam().kernel)) << "a kernel without a closed form here";
    const ClosedForm& form = forms.at(GetParam().kernel);
    constexpr int exact = 9;
    const std::map<Domain, std::vector<int>> rules{{Domain::cell, {exact}},
                                                   {Domain::facet, {exact}},
                                                   {Domain::contact, {0, 1, 3, 5, 7, 9}},
                                                   {Domain::nodes, {0}}};
    const bool is_contact = form.domain == Domain::contact || form.domain == Domain::nodes;
    for (std::size_t shape = 0; shape < triangles.size(); ++shape) {
        const Triangle& triangle = triangles[shape];
        const int degree = GetParam().degree;
        for (const Situation& at :
             is_contact ? contact_situations(triangle, degree) : std::vector{body(triangle, degree)}) {
            for (std::size_t facet = 0; facet < (form.domain == Domain::cell ? 1U : 3U); ++facet) {
                for (const int rule : rules.at(form.domain)) {
                    SCOPED_TRACE("triangle " + std::to_string(shape) + ", " + at.name + ", facet " +
                                 std::to_string(facet) + ", rule " + std::to_string(rule));
                    check(form, at, facet, rule);
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Table, Kernels, testing::ValuesIn(kernels_of("triangle")), [](const auto& info) {
    std::string name = info.param.kernel + "_" + std::to_string(info.param.degree);
    std::ranges::replace(name, '.', '_');
    return name;
});

/// Every closed form has its kernels, for every cell and both degrees: none was renamed away.
TEST(KernelTable, IsComplete) {
    std::set<std::string> expected;
    for (const auto& [name, form] : closed_forms()) {
        expected.insert({name + " 1", name + " 2"});
    }
    for (const char* cell : {"triangle", "quadrilateral", "tetrahedron", "hexahedron"}) {
        std::set<std::string> found;
        for (const Named& kernel : kernels_of(cell)) {
            found.insert(kernel.kernel + " " + std::to_string(kernel.degree));
        }
        EXPECT_EQ(found, expected) << cell;
    }
}

TEST(KernelTable, UnknownNamesAreErrorsOfTheProgram) {
    EXPECT_THROW(find_kernel("elasticity.sticktion", "triangle", 1), std::logic_error);
    EXPECT_THROW(find_kernel("elasticity.stiffness", "triangle", 7), std::logic_error);
    EXPECT_THROW(find_kernel("elasticity.stiffness", "heptagon", 1), std::logic_error);
    const thermocontact_kernel& one = linked_kernels().back();
    EXPECT_EQ(find_kernel(one.name, one.cell, one.degree, {&one, 1}).name, one.name) << "a table of one";
    EXPECT_THROW(find_kernel("elasticity.stiffness", "triangle", 1, {&one, 1}), std::logic_error);
    EXPECT_NE(kernel_provenance().find("FFCx"), std::string::npos);
}

}  // namespace
}  // namespace thermocontact::fem

#include "solve/condensed_system.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "model/nodal.h"
#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

using support::as_vector;
using support::dense;

CondensedSystem condensed(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                          const std::vector<char>& contact) {
    return {matrix, fixed, contact, InteriorOrders(*matrix.graph).without(contact),
            std::make_shared<Workers>(1)};
}

/// A square of elastic material, of degree `degree`, mass included where `density` > 0.
struct Body {
    support::Discretisation at;
    fem::BlockMatrix matrix;

    Body(int degree, double density)
        : at("mesh = {cells = [4, 3], diagonal = \"left\"}\ntime = {end = 1, steps = 1}\nheat.capacity = "
             "1\nspace.degree = " +
             std::to_string(degree)),
          matrix(fem::zero_matrix(at.graph, 2, 2)) {
        const fem::Constants constants{{"rho", {density}}, {"E", {6, 2, 0.4, 2, 4, -0.3, 0.4, -0.3, 1.5}}};
        for (const char* name : {"inertia.mass", "elasticity.stiffness"}) {
            auto kernel = fem::find_kernel(name, "triangle", degree);
            matrix.add(
                1.0, fem::assemble_matrix({std::move(kernel), at.mesh, constants}, at.space, at.graph, 2, 2));
        }
    }

    template <typename Predicate>
    std::vector<char> nodes(Predicate predicate) const {
        std::vector<char> result;
        for (const mesh::Point& x : at.space.nodes) {
            result.push_back(predicate(x[0], x[1]) ? 1 : 0);
        }
        return result;
    }
};

struct Case {
    std::string name;
    int degree;
    double density;
    bool (*contact)(double x, double y);
    bool (*fixed)(double x, double y, std::size_t component);
};

const auto bottom = [](double, double y) { return y == 0.0; };
const auto nowhere = [](double, double) { return false; };
const auto everywhere = [](double, double) { return true; };
const auto on_top = [](double, double y, std::size_t) { return y == 1.0; };
const auto free_body = [](double, double, std::size_t) { return false; };
/// Rollers: x fixed on the left, which shares its lowest node with the contact; y fixed on the right.
const auto rollers = [](double x, double, std::size_t c) {
    return (x == 0.0 && c == 0) || (x == 1.0 && c == 1);
};

const std::vector<Case> cases{{"clamped", 1, 0, bottom, on_top},
                              {"clamped_quadratic", 2, 0, bottom, on_top},
                              {"no_contact", 1, 0, nowhere, on_top},
                              {"contact_everywhere", 1, 1, everywhere, free_body},
                              {"nodes_partly_fixed", 1, 1, bottom, rollers},
                              {"nodes_partly_fixed_quadratic", 2, 0, bottom, rollers},
                              {"free_with_mass", 2, 1, bottom, free_body},
                              {"held_by_contact_alone", 1, 0, bottom, free_body},
                              {"held_by_contact_alone_quadratic", 2, 0, bottom, free_body}};

class Condensed : public testing::TestWithParam<Case> {
  protected:
    Body body{GetParam().degree, GetParam().density};
    std::vector<char> contact = body.nodes(GetParam().contact);
    std::vector<char> fixed = [this] {
        std::vector<char> result;
        for (const mesh::Point& x : body.at.space.nodes) {
            for (std::size_t c = 0; c < 2; ++c) {
                result.push_back(GetParam().fixed(x[0], x[1], c) ? 1 : 0);
            }
        }
        return result;
    }();
    CondensedSystem system = condensed(body.matrix, fixed, contact);
    Eigen::MatrixXd A = dense(body.matrix);
    Eigen::Index n = A.rows();
    Eigen::VectorXd r = as_vector(support::random_numbers(static_cast<std::size_t>(n), 3));

    bool is_contact(Eigen::Index dof) const { return contact[dof / 2] != 0 && fixed[dof] == 0; }
};

TEST_P(Condensed, ContactDofsAreTheFreeOnesOfContactNodes) {
    std::vector<std::int32_t> expected, found = system.contact_dofs();
    for (Eigen::Index dof = 0; dof < n; ++dof) {
        if (is_contact(dof)) {
            expected.push_back(static_cast<std::int32_t>(dof));
        }
    }
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(system.schur_complement().rows(), static_cast<Eigen::Index>(expected.size()));
    EXPECT_GT(system.factor_entries(), expected.size() == static_cast<std::size_t>(n) ? -1 : 0);
}

/// With springs K_c on the contact unknowns, S x_c + K_c x_c = s must give what the full system A + K_c does.
/// The full one is well conditioned (a few 1000, smallest eigenvalue of the order of 0.1): 1e-12 is a hundred
/// times its round-off.
TEST_P(Condensed, AgreesWithTheFullSystem) {
    const auto& dofs = system.contact_dofs();
    const auto n_c = static_cast<Eigen::Index>(dofs.size());
    Eigen::MatrixXd spring = 5 * Eigen::MatrixXd::Identity(n_c, n_c);
    if (n_c > 1) {
        spring(0, n_c - 1) = 0.7;  // not symmetric, as friction is not
    }
    const double round_off = 1e-12;
    Eigen::MatrixXd full = A;
    Eigen::VectorXd rhs = r;
    for (Eigen::Index i = 0; i < n_c; ++i) {
        for (Eigen::Index j = 0; j < n_c; ++j) {
            full(dofs[i], dofs[j]) += spring(i, j);
        }
    }
    for (Eigen::Index dof = 0; dof < n; ++dof) {
        if (fixed[dof] != 0) {
            full.row(dof).setZero();
            full.col(dof).setZero();
            full(dof, dof) = 1;
            rhs[dof] = -7;
        }
    }
    const Eigen::VectorXd expected = full.partialPivLu().solve(rhs);

    std::vector<double> solution(static_cast<std::size_t>(n), -7.0);
    for (int round = 0; round < 2; ++round) {  // the second must not see the first
        const Eigen::VectorXd s = system.condense(support::as_std(r));
        ASSERT_EQ(s.size(), n_c);
        const Eigen::MatrixXd condensed = system.schur_complement() + spring;
        const Eigen::VectorXd x =
            n_c > 0 ? Eigen::VectorXd(condensed.partialPivLu().solve(s)) : Eigen::VectorXd();
        system.expand(x, solution);
        EXPECT_LE((as_vector(solution) - expected).cwiseAbs().maxCoeff(),
                  round_off * expected.cwiseAbs().maxCoeff());
    }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Condensed, testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

/// The Schur complement of a body held by contact alone is singular as A is: rigid motions of the contact
/// nodes.
TEST(CondensedSystem, RigidMotionsAreInTheKernelOfS) {
    const Body body(1, 0);
    const CondensedSystem system =
        condensed(body.matrix, std::vector<char>(2 * body.at.node_count(), 0), body.nodes(bottom));
    Eigen::VectorXd rotation(system.contact_dofs().size());
    for (std::size_t i = 0; i < system.contact_dofs().size(); ++i) {
        const mesh::Point& x = body.at.space.nodes[system.contact_dofs()[i] / 2];
        rotation[static_cast<Eigen::Index>(i)] = system.contact_dofs()[i] % 2 == 0 ? -x[1] : x[0];
    }
    const Eigen::MatrixXd& S = system.schur_complement();
    EXPECT_LE((S * rotation).norm(), 1e-13 * S.norm() * rotation.norm());
}

/// Without anything that holds it, the body's system is singular; the dof at fault is one of the free ones.
TEST(CondensedSystem, FreeBodyIsSingular) {
    const Body body(1, 0);
    std::vector<char> fixed(2 * body.at.node_count(), 0);
    fixed[0] = 1;  // one component of one node is not enough
    try {
        condensed(body.matrix, fixed, std::vector<char>(body.at.node_count(), 0));
        FAIL() << "no exception";
    } catch (const NotPositiveDefinite& failure) {
        ASSERT_GE(failure.row, 0);
        ASSERT_LT(failure.row, static_cast<std::int32_t>(fixed.size()));
        EXPECT_EQ(fixed[failure.row], 0);
    }
}

TEST(CondensedSystem, EverythingFixed) {
    const Body body(1, 0);
    const std::vector<char> all(2 * body.at.node_count(), 1);
    CondensedSystem system = condensed(body.matrix, all, body.nodes(bottom));
    EXPECT_EQ(system.condense(std::vector<double>(all.size(), 1.0)).size(), 0);
    std::vector<double> solution(all.size(), -7.0);
    system.expand({}, solution);
    EXPECT_EQ(solution, std::vector<double>(all.size(), -7.0));
    EXPECT_EQ(system.factor_entries(), 0);
}

/// Scalar systems (heat) condense alike.
TEST(CondensedSystem, OneComponent) {
    const support::Discretisation at("mesh.cells = [5, 4]\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n");
    const fem::Constants constants{{"c", {1.0}}, {"K", {1, 0.25, 0.25, 0.6}}};
    fem::BlockMatrix matrix = fem::zero_matrix(at.graph, 1, 1);
    std::vector<char> contact, fixed;
    for (const char* name : {"heat_capacity.capacity", "conduction.conduction"}) {
        matrix.add(1.0, fem::assemble_matrix({fem::find_kernel(name, "triangle", 1), at.mesh, constants},
                                             at.space, at.graph, 1, 1));
    }
    for (const mesh::Point& x : at.space.nodes) {
        contact.push_back(x[1] == 0.0 ? 1 : 0);
        fixed.push_back(x[0] == 0.0 ? 1 : 0);
    }
    CondensedSystem system = condensed(matrix, fixed, contact);
    EXPECT_EQ(system.contact_dofs().size(), 5U);
    const auto r = support::random_numbers(at.node_count());
    const Eigen::VectorXd s = system.condense(r);
    std::vector<double> solution(at.node_count(), 0.0);
    system.expand(system.schur_complement().partialPivLu().solve(s), solution);
    Eigen::VectorXd residual = dense(matrix) * as_vector(solution) - as_vector(r);
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        EXPECT_NEAR(fixed[i] != 0 ? 0.0 : residual[static_cast<Eigen::Index>(i)], 0.0, 1e-13);
    }
}

}  // namespace
}  // namespace thermocontact::solve

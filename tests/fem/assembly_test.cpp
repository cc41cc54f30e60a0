#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <set>

#include "fem/block_matrix.h"
#include "mesh/shapes.h"
#include "support/dense.h"

namespace thermocontact::fem {
namespace {

using support::dense;

constexpr double width = 1.5, height = 0.7, area = width * height;

const Constants constants{{"rho", {1.7}},
                          {"c", {2.3}},
                          {"E", {6, 2, 0.4, 2, 4, -0.3, 0.4, -0.3, 1.5}},
                          {"Visc", {1.2, 0.2, 0.05, 0.2, 0.8, 0.1, 0.05, 0.1, 0.3}},
                          {"K", {1, 0.25, 0.25, 0.6}},
                          {"M", {0.3, 0.1, 0.1, 0.2}},
                          {"R", {0.4, -0.1, -0.1, 0.3}}};

/// Entries of assembled matrices are sums over at most 8 cells; those of products over a row with some 50
/// entries of the largest size.
double round_off(const Eigen::MatrixXd& matrix) {
    return 1000 * std::numeric_limits<double>::epsilon() * matrix.cwiseAbs().maxCoeff();
}

Eigen::Index rank(const Eigen::MatrixXd& matrix) {
    Eigen::FullPivLU<Eigen::MatrixXd> factors(matrix);
    return factors.setThreshold(1e-10).rank();
}

struct Case {
    std::string diagonal;
    int degree;
};

class Assembly : public testing::TestWithParam<Case> {
  protected:
    const mesh::Mesh mesh = mesh::make_rectangle(
        {"rectangle", {-0.4, 0.2}, {-0.4 + width, 0.2 + height}, {4, 3}, GetParam().diagonal});
    const Space space = make_space(mesh, GetParam().degree);
    const NodeGraph graph = make_node_graph(space);

    Eigen::MatrixXd matrix(const std::string& name, int rows, int columns) const {
        auto kernel = find_kernel(name, "triangle", GetParam().degree);
        return dense(assemble_matrix({std::move(kernel), mesh, constants}, space, graph, rows, columns));
    }

    /// [nodes][components] of a field of x and y.
    template <typename Function>
    Eigen::VectorXd nodal(Function function) const {
        std::vector<double> values;
        for (const mesh::Point& x : space.nodes) {
            for (const double value : function(x[0], x[1])) {
                values.push_back(value);
            }
        }
        return support::as_vector(values);
    }

    Eigen::VectorXd translation(int component) const {
        return nodal([&](double, double) {
            return std::array<double, 2>{component == 0 ? 1.0 : 0.0, component == 1 ? 1.0 : 0.0};
        });
    }
    Eigen::VectorXd rotation() const {
        return nodal([](double x, double y) { return std::array<double, 2>{-y, x}; });
    }
};

TEST_P(Assembly, GraphCouplesTheNodesThatShareACell) {
    std::vector<std::set<std::int32_t>> neighbours(space.nodes.size());
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        for (const std::int32_t node : space.dofmap.of(cell)) {
            neighbours[node].insert(space.dofmap.of(cell).begin(), space.dofmap.of(cell).end());
        }
    }
    ASSERT_EQ(graph.node_count(), space.dofmap.node_count);
    for (std::size_t node = 0; node < neighbours.size(); ++node) {
        const std::vector<std::int32_t> row(graph.columns.begin() + graph.offsets[node],
                                            graph.columns.begin() + graph.offsets[node + 1]);
        const auto itself = neighbours[node].find(static_cast<std::int32_t>(node));
        EXPECT_EQ(row, std::vector<std::int32_t>(itself, neighbours[node].end())) << "node " << node;
    }
}

TEST_P(Assembly, CellPositionsPointToThePairsOfNodes) {
    const auto n = static_cast<std::size_t>(space.dofmap.nodes_per_cell);
    ASSERT_EQ(graph.cell_positions.size(), n * n * mesh.cell_count());
    const std::int32_t* position = graph.cell_positions.data();
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        for (const std::int32_t row : space.dofmap.of(cell)) {
            for (const std::int32_t column : space.dofmap.of(cell)) {
                EXPECT_GE(*position, graph.offsets[std::min(row, column)]);
                EXPECT_LT(*position, graph.offsets[std::min(row, column) + 1]);
                EXPECT_EQ(graph.columns[*position++], std::max(row, column));
            }
        }
    }
}

TEST_P(Assembly, OperatorsHavePositiveDiagonals) {
    for (const auto& [name, components] :
         std::vector<std::pair<std::string, int>>{{"inertia.mass", 2},
                                                  {"elasticity.stiffness", 2},
                                                  {"viscosity.damping", 2},
                                                  {"norms.strains", 2},
                                                  {"conduction.conduction", 1},
                                                  {"heat_capacity.capacity", 1}}) {
        const Eigen::MatrixXd A = matrix(name, components, components);
        EXPECT_GT(A.diagonal().minCoeff(), 0.0) << name;
    }
}

TEST_P(Assembly, RefusesSquareFormsThatAreNotSymmetric) {
    const auto stiffness = find_kernel("elasticity.stiffness", "triangle", GetParam().degree);
    EXPECT_THROW(assemble_matrix({stiffness, mesh, {{"E", {6, 2, 0.4, 2.1, 4, -0.3, 0.4, -0.3, 1.5}}}}, space,
                                 graph, 2, 2),
                 std::logic_error);
}

TEST_P(Assembly, MassAndCapacityAddUp) {
    const Eigen::MatrixXd M = matrix("inertia.mass", 2, 2), C = matrix("heat_capacity.capacity", 1, 1);
    const auto tolerance = [&](const Eigen::MatrixXd& A) {
        return round_off(A) * static_cast<double>(A.rows());
    };
    for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
            EXPECT_NEAR(translation(a).dot(M * translation(b)), a == b ? 1.7 * area : 0.0, tolerance(M));
        }
    }
    EXPECT_NEAR(C.sum(), 2.3 * area, tolerance(C));
}

/// Rigid motions and constant temperatures, and nothing else: the operators' kernels have dimension 3 and 1.
TEST_P(Assembly, RigidMotionsMakeNoStressAndConstantsNoFlux) {
    for (const char* name : {"elasticity.stiffness", "viscosity.damping", "norms.strains"}) {
        const Eigen::MatrixXd A = matrix(name, 2, 2);
        for (const Eigen::VectorXd& motion : {translation(0), translation(1), rotation()}) {
            EXPECT_LE((A * motion).cwiseAbs().maxCoeff(), round_off(A) * motion.cwiseAbs().maxCoeff())
                << name;
        }
        EXPECT_EQ(rank(A), A.rows() - 3) << name;
    }
    const Eigen::MatrixXd K = matrix("conduction.conduction", 1, 1);
    EXPECT_LE(K.rowwise().sum().cwiseAbs().maxCoeff(), round_off(K));
    EXPECT_EQ(rank(K), K.rows() - 1);
}

/// A linear displacement has the same strain everywhere: its energy is area e.C e.
TEST_P(Assembly, EnergyOfUniformStrain) {
    const Eigen::VectorXd u = nodal([](double x, double y) {
        return std::array<double, 2>{0.1 * x - 0.3 * y, 0.5 * x + 0.2 * y};
    });
    const Eigen::Vector3d e(0.1, 0.2, 0.2);
    const Eigen::Matrix3d E = Eigen::Map<const Eigen::Matrix3d>(constants.at("E").data());
    const Eigen::MatrixXd A = matrix("elasticity.stiffness", 2, 2);
    EXPECT_NEAR(u.dot(A * u), area * e.dot(E * e), round_off(A) * A.rows());
    const Eigen::MatrixXd G = matrix("norms.strains", 2, 2);
    EXPECT_NEAR(u.dot(G * u), area * (0.1 * 0.1 + 0.2 * 0.2 + 2 * 0.1 * 0.1), round_off(G) * G.rows());
}

/// Of a uniform strain the heat is R : e area; a uniform temperature does the work theta M : e area on it.
TEST_P(Assembly, CouplingsOfUniformFields) {
    const Eigen::VectorXd u = nodal([](double x, double y) {
        return std::array<double, 2>{0.1 * x - 0.3 * y, 0.5 * x + 0.2 * y};
    });
    const Eigen::MatrixXd R = matrix("strain_heating.coupling", 1, 2),
                          M = matrix("thermal_stress.coupling", 2, 1);
    EXPECT_NEAR((R * u).sum(), area * (0.4 * 0.1 - 2 * 0.1 * 0.1 + 0.3 * 0.2), round_off(R) * R.rows());
    EXPECT_NEAR(u.dot(M * Eigen::VectorXd::Ones(M.cols())), area * (0.3 * 0.1 + 2 * 0.1 * 0.1 + 0.2 * 0.2),
                round_off(M) * M.rows());
}

TEST_P(Assembly, LoadsAddUp) {
    const std::vector<double> f = support::as_std(nodal([](double, double) {
        return std::array<double, 2>{3.0, -2.0};
    }));
    const Fields fields{{"f", {&f, 2, &space.dofmap}}};
    Form body(find_kernel("body_force.load", "triangle", GetParam().degree), mesh, {}, fields);
    Form side(find_kernel("traction.load", "triangle", GetParam().degree), mesh, {}, fields);
    std::vector<double> load(f.size(), 0.0), traction(f.size(), 0.0);
    assemble_cells(body, space.dofmap, 2, load);
    assemble_facets(side, mesh.facets, space.dofmap, 2, traction);
    const auto total = [](const std::vector<double>& vector, int component) {
        double sum = 0;
        for (auto i = static_cast<std::size_t>(component); i < vector.size(); i += 2) {
            sum += vector[i];
        }
        return sum;
    };
    const double tolerance = 1e-13;  // sums of 100 numbers below 1
    EXPECT_NEAR(total(load, 0), 3 * area, tolerance);
    EXPECT_NEAR(total(load, 1), -2 * area, tolerance);
    EXPECT_NEAR(total(traction, 0), 3 * 2 * (width + height), tolerance);
    EXPECT_NEAR(total(traction, 1), -2 * 2 * (width + height), tolerance);
}

TEST_P(Assembly, IntegrateMeasuresTheBoundary) {
    const std::vector<double> zero2(2 * space.nodes.size(), 0.0), zero(space.nodes.size(), 0.0);
    const Fields fields{{"u", {&zero2, 2, &space.dofmap}},
                        {"w", {&zero2, 2, &space.dofmap}},
                        {"g", {&zero, 1, &space.dofmap}}};
    for (const int rule : {0, 1, 3, 5, 7, 9}) {
        Form form(find_kernel("kinematics.area", "triangle", GetParam().degree), mesh, {{"eps", {1.0}}},
                  fields, rule);
        EXPECT_NEAR(integrate(form, mesh.facets), 2 * (width + height), 1e-13) << "rule " << rule;
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Assembly,
                         testing::Values(Case{"right", 1}, Case{"left", 1}, Case{"crossed", 1},
                                         Case{"right", 2}, Case{"left", 2}, Case{"crossed", 2}),
                         [](const auto& info) {
                             return info.param.diagonal + "_" + std::to_string(info.param.degree);
                         });

TEST(BlockMatrix, MultipliesLikeADenseMatrix) {
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {3, 2}, "crossed"});
    const Space space = make_space(mesh, 2);
    const NodeGraph graph = make_node_graph(space);
    for (const auto& [rows, columns] :
         std::vector<std::pair<int, int>>{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {3, 1}, {3, 3}}) {
        BlockMatrix matrix = zero_matrix(graph, rows, columns);
        matrix.values = support::random_numbers(matrix.values.size());
        for (int node = 0; node < graph.node_count() && !matrix.symmetric(); ++node) {
            const int size = rows * columns;  // a node and itself are one pair: its second block stays zero
            std::fill_n(matrix.values.begin() + (2 * graph.offsets[node] + 1) * size, size, 0.0);
        }
        const auto x = support::random_numbers(static_cast<std::size_t>(graph.node_count() * columns), 2);
        const Eigen::VectorXd expected = dense(matrix) * support::as_vector(x);
        const Eigen::VectorXd found = support::as_vector(matrix.multiply(x));
        ASSERT_EQ(found.size(), expected.size());
        // rows of at most 25 blocks: 75 products of numbers below 1
        EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 75 * std::numeric_limits<double>::epsilon())
            << rows << "x" << columns;
        if (matrix.symmetric()) {
            const double square = support::as_vector(x).dot(expected);
            EXPECT_NEAR(matrix.quadratic_form(x), square,
                        expected.size() * 75 * std::numeric_limits<double>::epsilon());
        }
        std::vector<double> reused(static_cast<std::size_t>(expected.size()), 1e300);
        matrix.multiply(x, reused);
        EXPECT_EQ(reused, matrix.multiply(x));
    }
}

TEST(BlockMatrix, AddsMultiples) {
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {2, 2}, "right"});
    const Space space = make_space(mesh, 1);
    const NodeGraph graph = make_node_graph(space);
    BlockMatrix sum = zero_matrix(graph, 2, 1), other = zero_matrix(graph, 2, 1);
    EXPECT_EQ(dense(sum).cwiseAbs().maxCoeff(), 0.0);
    other.values = support::random_numbers(other.values.size());
    sum.add(2.0, other);
    sum.add(-0.5, other);
    EXPECT_EQ(dense(sum), 1.5 * dense(other));
}

/// Blocks that are multiples of the identity are kept as one number each; others must not be.
TEST(BlockMatrix, CompressesMultiplesOfTheIdentityOnly) {
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {3, 2}, "crossed"});
    const Space space = make_space(mesh, 1);
    const NodeGraph graph = make_node_graph(space);
    BlockMatrix scaled = zero_matrix(graph, 2, 2);
    const std::vector<double> factors = support::random_numbers(scaled.values.size() / 4);
    for (std::size_t i = 0; i < factors.size(); ++i) {
        scaled.values[4 * i] = scaled.values[4 * i + 3] = factors[i];
    }
    BlockMatrix unequal = scaled, skewed = scaled;
    unequal.values[3] *= 2;
    skewed.values[5] = 0.1;
    for (BlockMatrix* matrix : {&scaled, &unequal, &skewed}) {
        const BlockMatrix before = *matrix;
        matrix->compress();
        EXPECT_EQ(matrix->values.size(), before.values.size() / (matrix == &scaled ? 4 : 1));
        const auto x = support::random_numbers(static_cast<std::size_t>(graph.node_count() * 2), 2);
        const Eigen::VectorXd expected = support::as_vector(before.multiply(x));
        const double tolerance = 100 * std::numeric_limits<double>::epsilon();  // rows of at most 9 blocks
        EXPECT_LE((support::as_vector(matrix->multiply(x)) - expected).cwiseAbs().maxCoeff(), tolerance);
        EXPECT_NEAR(matrix->quadratic_form(x), before.quadratic_form(x), tolerance * graph.node_count());
    }
}

class Forms : public testing::Test {
  protected:
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {1, 1}, "right"});
    const Space space = make_space(mesh, 1);
    const Kernel mass = find_kernel("heat_capacity.capacity", "triangle", 1);
};

TEST_F(Forms, MissingNamesAreErrorsOfTheProgram) {
    EXPECT_THROW(Form(mass, mesh, {}), std::logic_error);
    EXPECT_THROW(Form(find_kernel("body_force.load", "triangle", 1), mesh, {}), std::logic_error);
    EXPECT_NO_THROW(Form(mass, mesh, {{"c", {1.0}}, {"unused", {2.0}}}));
}

TEST_F(Forms, RulesThatWereNotCompiledAreErrorsOfTheProgram) {
    const std::vector<double> zero(8, 0.0);
    const Field field{&zero, 2, &space.dofmap}, scalar{&zero, 1, &space.dofmap};
    const Fields fields{{"u", field}, {"w", field}, {"g", scalar}};
    const Kernel area = find_kernel("kinematics.area", "triangle", 1);
    EXPECT_THROW(Form(area, mesh, {{"eps", {1.0}}}, fields, 4), std::logic_error);
    EXPECT_NO_THROW(Form(area, mesh, {{"eps", {1.0}}}, fields, 5));
}

TEST_F(Forms, ConstantsCanChange) {
    Form form(mass, mesh, {{"c", {1.0}}});
    std::vector<double> before(9, 0.0), after(9, 0.0);
    form.add_cell(0, before);
    form.set_constant("c", 3.0);
    form.set_constant("absent", 7.0);
    form.add_cell(0, after);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_DOUBLE_EQ(after[i], 3 * before[i]);
    }
}

/// Each region takes its own set, cells of no region the last one; a constant is changed in all of them.
TEST_F(Forms, RegionsHaveTheirOwnConstants) {
    mesh::Mesh parts = mesh::make_rectangle({"rectangle", {0, 0}, {2, 1}, {2, 1}, "right"});
    parts.region_names = {"a", "b"};
    parts.cell_regions = {0, 1, -1, 0};
    Form form = Form::by_region(mass, parts, {{{"c", {2.0}}}, {{"c", {3.0}}}, {{"c", {5.0}}}});
    Form plain(mass, parts, {{"c", {1.0}}});
    const auto ratio = [&](std::int32_t cell) {
        std::vector<double> found(9, 0.0), unit(9, 0.0);
        form.add_cell(cell, found);
        plain.add_cell(cell, unit);
        return found[0] / unit[0];
    };
    const double expected[] = {2, 3, 5, 2};
    for (std::int32_t cell = 0; cell < 4; ++cell) {
        EXPECT_DOUBLE_EQ(ratio(cell), expected[cell]) << cell;
    }
    form.set_constant("c", 7.0);
    for (std::int32_t cell = 0; cell < 4; ++cell) {
        EXPECT_DOUBLE_EQ(ratio(cell), 7.0) << cell;
    }
}

TEST_F(Forms, TensorsAreAddedTo) {
    Form form(mass, mesh, {{"c", {1.0}}});
    std::vector<double> once(9, 0.0), twice(9, 0.0);
    form.add_cell(0, once);
    form.add_cell(0, twice);
    form.add_cell(0, twice);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_DOUBLE_EQ(twice[i], 2 * once[i]);
    }
}

}  // namespace
}  // namespace thermocontact::fem

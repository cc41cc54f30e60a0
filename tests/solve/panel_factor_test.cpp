#include "solve/panel_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/shapes.h"
#include "support/dense.h"
#include "support/laplacian.h"
#include "support/permuted.h"

namespace thermocontact::solve {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

SymmetricMatrix lower_triangle(const Eigen::MatrixXd& A, std::span<const std::int32_t> dense_rows) {
    SymmetricMatrix result{static_cast<std::int32_t>(A.rows()), {0}, {}, {}};
    const auto is_dense = [&](std::int32_t i) {
        return std::ranges::find(dense_rows, i) != dense_rows.end();
    };
    for (std::int32_t column = 0; column < result.size; ++column) {
        for (std::int32_t row = column; row < result.size; ++row) {
            if (A(row, column) != 0.0 || row == column || (is_dense(row) && is_dense(column))) {
                result.rows.push_back(row);
                result.values.push_back(A(row, column));
            }
        }
        result.offsets.push_back(static_cast<std::int32_t>(result.rows.size()));
    }
    return result;
}

/// Sparse, random, diagonally dominant: positive definite with condition number below 10.
Eigen::MatrixXd random_positive(int size, int entries_a_row) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    const auto values = support::random_numbers(static_cast<std::size_t>(size * entries_a_row), 11);
    const auto places = support::random_numbers(values.size(), 12);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int one = static_cast<int>(i) / entries_a_row,
                  other = static_cast<int>((places[i] + 1) / 2 * size);
        A(one, other) += values[i];
        A(other, one) += values[i];
    }
    A.diagonal() = 1.2 * A.cwiseAbs().rowwise().sum().array() + 0.1;
    return A;
}

/// Mass plus stiffness of a square, as a step has it.
Eigen::MatrixXd finite_elements() {
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {6, 5}, "right"});
    const fem::Space space = fem::make_space(mesh, 1);
    const fem::NodeGraph graph = fem::make_node_graph(space);
    const fem::Constants constants{{"rho", {1.0}}, {"E", {6, 2, 0.4, 2, 4, -0.3, 0.4, -0.3, 1.5}}};
    const auto matrix = [&](const char* name) {
        return fem::assemble_matrix({fem::find_kernel(name, "triangle", 1), mesh, constants}, space, graph, 2,
                                    2);
    };
    fem::BlockMatrix sum = matrix("inertia.mass");
    sum.add(0.1, matrix("elasticity.stiffness"));
    return support::dense(sum);
}

struct Case {
    std::string name;
    Eigen::MatrixXd matrix;
    int tail;
    std::int64_t smallest_cut;  ///< of the factor into branches
    Storage storage = Storage::doubles;
};

std::vector<Case> cases() {
    std::vector<Case> result;
    const auto add = [&](const std::string& name, const Eigen::MatrixXd& A) {
        const int n = static_cast<int>(A.rows());
        for (const int tail : {0, 1, 2, 3, 4, 5, 7, n / 2, n - 1, n}) {
            if (tail <= n && (result.empty() || result.back().name != name || result.back().tail < tail)) {
                result.push_back({name, A, tail, worth_threads});
                result.push_back({name, A, tail, 0});
                result.push_back({name, A, tail, 0, Storage::words});
            }
        }
    };
    add("one_number", Eigen::MatrixXd::Constant(1, 1, 4.0));
    add("diagonal", Eigen::VectorXd::LinSpaced(9, 1, 5).asDiagonal().toDenseMatrix());
    add("random_sparse", random_positive(60, 2));
    add("random_dense", random_positive(37, 30));
    add("finite_elements", finite_elements());
    return result;
}

class Factor : public testing::TestWithParam<Case> {
  protected:
    const Eigen::MatrixXd& A = GetParam().matrix;
    const Eigen::Index n = A.rows(), t = GetParam().tail;
    /// An order without structure: a stride through the rows.
    const std::vector<std::int32_t> order = [this] {
        std::vector<std::int32_t> result(static_cast<std::size_t>(n));
        std::iota(result.begin(), result.end(), 0);
        std::ranges::reverse(result);
        for (std::size_t i = 2; i < result.size(); i += 3) {
            std::swap(result[i], result[(7 * i) % result.size()]);
        }
        return result;
    }();
    const std::span<const std::int32_t> tail = std::span(order).last(static_cast<std::size_t>(t));
    PanelFactor factor{support::permuted(lower_triangle(A, tail), order), static_cast<std::int32_t>(t),
                       std::make_shared<Workers>(3), GetParam().storage, GetParam().smallest_cut};

    /// Row of A that is i-th in the factor.
    std::int32_t row(Eigen::Index i) const {
        return order[static_cast<std::size_t>(factor.order()[static_cast<std::size_t>(i)])];
    }

    /// A with its rows and columns in the factor's order.
    Eigen::MatrixXd permuted() const {
        Eigen::MatrixXd result(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) {
                result(i, j) = A(row(i), row(j));
            }
        }
        return result;
    }
};

/// Backward stable: errors of n u |A|, times the condition number (below 1000 here) in solutions. Words hold
/// each number of L to u = 2^-32 of its column's largest, which are errors of n u |L|^2 at most.
double tolerance(const Eigen::MatrixXd& A, Storage storage) {
    const double u = storage == Storage::words ? 0x1p-32 : epsilon;
    return 10 * static_cast<double>(A.rows()) * u * A.norm();
}
constexpr double condition = 1000;

TEST_P(Factor, KeepsTheTailLast) {
    std::vector<std::int32_t> all = factor.order(), now(all.end() - t, all.end()),
                              wanted(static_cast<std::size_t>(t));
    std::iota(wanted.begin(), wanted.end(), static_cast<std::int32_t>(n - t));
    std::ranges::sort(all);
    std::ranges::sort(now);
    std::ranges::sort(wanted);
    EXPECT_EQ(now, wanted);
    for (std::size_t i = 0; i < all.size(); ++i) {
        ASSERT_EQ(all[i], static_cast<std::int32_t>(i)) << "not a permutation";
    }
}

TEST_P(Factor, SchurComplement) {
    const Eigen::MatrixXd P = permuted();
    const Eigen::Index h = n - t;
    Eigen::MatrixXd expected = P.bottomRightCorner(t, t);
    if (h > 0 && t > 0) {
        expected -= P.bottomLeftCorner(t, h) * P.topLeftCorner(h, h).ldlt().solve(P.topRightCorner(h, t));
    }
    ASSERT_EQ(factor.schur_complement().rows(), t);
    if (t > 0) {
        EXPECT_LE((factor.schur_complement() - expected).cwiseAbs().maxCoeff(),
                  tolerance(A, Storage::doubles))
            << "in double precision however the head is stored";
    }
}

TEST_P(Factor, SolvesWithTheTailSolvedByItself) {
    const Eigen::VectorXd b = support::as_vector(support::random_numbers(static_cast<std::size_t>(n), 5));
    std::vector<double> x(static_cast<std::size_t>(n));
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] = b[row(i)];
    }
    factor.forward(x);
    Eigen::Map<Eigen::VectorXd> x_tail(x.data() + n - t, t);
    if (t > 0) {
        x_tail = factor.schur_complement().llt().solve(x_tail).eval();
    }
    factor.backward(x);
    const Eigen::VectorXd expected = A.llt().solve(b);
    for (Eigen::Index i = 0; i < n; ++i) {
        EXPECT_NEAR(x[i], expected[row(i)],
                    condition * tolerance(A, GetParam().storage) * expected.norm() / A.norm());
    }
}

/// forward() alone: the head is L^-1 b, the tail the right-hand side of the Schur complement.
TEST_P(Factor, ForwardCondensesTheRightHandSide) {
    const Eigen::MatrixXd P = permuted();
    const Eigen::Index h = n - t;
    const auto b = support::random_numbers(static_cast<std::size_t>(n), 6);
    std::vector<double> x = b;
    factor.forward(x);
    if (h > 0) {
        const Eigen::VectorXd b_head = support::as_vector(b).head(h);
        const Eigen::MatrixXd L = P.topLeftCorner(h, h).llt().matrixL();
        const Eigen::VectorXd y = L.triangularView<Eigen::Lower>().solve(b_head);
        EXPECT_LE((support::as_vector(x).head(h) - y).cwiseAbs().maxCoeff(),
                  condition * tolerance(A, GetParam().storage) * y.norm() / A.norm());
        if (t > 0) {
            const Eigen::VectorXd s = support::as_vector(b).tail(t) -
                                      P.bottomLeftCorner(t, h) * P.topLeftCorner(h, h).llt().solve(b_head);
            EXPECT_LE((support::as_vector(x).tail(t) - s).cwiseAbs().maxCoeff(),
                      condition * tolerance(A, GetParam().storage));
        }
    } else {
        EXPECT_EQ(x, b);
    }
}

/// The numbers of L's head are stored once: beside them a column has at most three numbers above the diagonal
/// in its group, seven to fill up its last chunk, and seven its group's triangle.
TEST_P(Factor, StoresNoMoreThanTheTriangle) {
    const std::int64_t h = n - t;
    EXPECT_GE(factor.entries(), h);
    EXPECT_LE(factor.entries(), h * (h + 1) / 2 + h * t + 17 * h);
}

INSTANTIATE_TEST_SUITE_P(Matrices, Factor, testing::ValuesIn(cases()), [](const auto& info) {
    return info.param.name + "_tail_" + std::to_string(info.param.tail) +
           (info.param.smallest_cut == 0 ? "_in_branches" : "") +
           (info.param.storage == Storage::words ? "_of_words" : "");
});

std::shared_ptr<Workers> alone() {
    return std::make_shared<Workers>(1);
}

struct BadCase {
    std::string name;
    Eigen::MatrixXd matrix;
    std::int32_t row;  ///< at fault, in the natural order
};

std::vector<BadCase> bad_cases() {
    // Laplacian of a path: singular, and only its last pivot shows it
    const int n = 12;
    Eigen::MatrixXd path = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i + 1 < n; ++i) {
        path(i, i) += 1;
        path(i + 1, i + 1) += 1;
        path(i, i + 1) = path(i + 1, i) = -1;
    }
    Eigen::MatrixXd negative = random_positive(20, 2), empty = random_positive(20, 2);
    negative(7, 7) = -1;
    empty.row(13).setZero();
    empty.col(13).setZero();
    return {{"singular_path", path, n - 1}, {"negative_diagonal", negative, 7}, {"empty_row", empty, 13}};
}

class Singular : public testing::TestWithParam<BadCase> {};

TEST_P(Singular, IsNotFactored) {
    const auto& [name, A, row] = GetParam();
    try {
        PanelFactor factor(lower_triangle(A, {}), 0, alone());
        FAIL() << "no exception";
    } catch (const NotPositiveDefinite& failure) {
        // the factor may refine the order; where a row alone is to blame, it is that row
        if (name == "singular_path") {
            EXPECT_GE(failure.row, 0);
            EXPECT_LT(failure.row, A.rows());
        } else {
            EXPECT_EQ(failure.row, row);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Matrices, Singular, testing::ValuesIn(bad_cases()),
                         [](const auto& info) { return info.param.name; });

/// Paths of springs that nothing holds: the last pivot is 0 but for round-off, about half of them above it.
TEST(PanelFactor, RoundOffIsNoPivot) {
    const int n = 12;
    for (unsigned seed = 1; seed <= 16; ++seed) {
        const auto random = support::random_numbers(n, seed);
        Eigen::MatrixXd path = Eigen::MatrixXd::Zero(n, n);
        for (int i = 0; i + 1 < n; ++i) {
            const double spring = 1.5 + random[static_cast<std::size_t>(i)];
            path.block<2, 2>(i, i) += spring * Eigen::Matrix2d{{1, -1}, {-1, 1}};
        }
        EXPECT_THROW(PanelFactor(lower_triangle(path, {}), 0, alone()), NotPositiveDefinite) << seed;
    }
}

TEST(NestedDissection, IsAPermutation) {
    EXPECT_TRUE(nested_dissection({0, {0}, {}, {}}).empty());
    EXPECT_EQ(nested_dissection({1, {0, 1}, {0}, {}}), std::vector<std::int32_t>{0});
    std::vector<std::int32_t> order = nested_dissection(lower_triangle(finite_elements(), {}));
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(order[i], static_cast<std::int32_t>(i));
    }
}

/// Of n x n nodes, regular.
SymmetricMatrix laplacian(int n) {
    return support::laplacian(n, 4.01);
}

SymmetricMatrix dissected(const SymmetricMatrix& matrix) {
    return support::permuted(matrix, nested_dissection(matrix));
}

/// On a grid of n x n nodes, L has some 31/4 n^2 log2 n entries in nested dissection against n^3 in the order
/// of the rows.
TEST(NestedDissection, SavesFill) {
    const int n = 96;
    const SymmetricMatrix grid = laplacian(n);
    const double nested = 31.0 / 4 * n * n * std::log2(n);
    EXPECT_LT(static_cast<double>(PanelFactor(dissected(grid), 0, alone()).entries()), nested);
    EXPECT_GT(static_cast<double>(PanelFactor(grid, 0, alone()).entries()),
              1.8 * nested);  // n^3 of them
}

class Branches : public testing::TestWithParam<Storage> {};

/// The last bit is the same however many threads share the branches, and every branch has its part.
TEST_P(Branches, TheNumberOfThreadsChangesNothing) {
    const SymmetricMatrix grid = dissected(laplacian(64));
    const auto solved = [&](int threads) {
        PanelFactor factor(grid, 20, std::make_shared<Workers>(threads), GetParam(), 0);
        std::vector<double> x = support::random_numbers(static_cast<std::size_t>(grid.size), 3);
        for (int again = 0; again < 20; ++again) {  // threads meet in another order each time
            factor.forward(x);
            factor.backward(x);
        }
        return x;
    };
    const std::vector<double> one = solved(1);
    EXPECT_EQ(one, solved(2));
    EXPECT_EQ(one, solved(4));
    EXPECT_EQ(one, solved(9));
}

INSTANTIATE_TEST_SUITE_P(Storages, Branches, testing::Values(Storage::doubles, Storage::words),
                         [](const auto& info) { return info.param == Storage::words ? "words" : "doubles"; });

/// Words are nearer to doubles than single precision would be: in a column whose numbers are alike, by far.
TEST(Words, AreFinerThanSinglePrecision) {
    const SymmetricMatrix grid = dissected(laplacian(32));
    const std::vector<double> b = support::random_numbers(static_cast<std::size_t>(grid.size), 3);
    const auto solved = [&](Storage storage) {
        PanelFactor factor(grid, 0, alone(), storage);
        std::vector<double> x = b;
        factor.forward(x);
        factor.backward(x);
        return support::as_vector(x);
    };
    const Eigen::VectorXd exact = solved(Storage::doubles), x = solved(Storage::words);
    EXPECT_NE(x, exact);
    EXPECT_LE((x - exact).norm(), 0x1p-27 * exact.norm());
}

}  // namespace
}  // namespace thermocontact::solve

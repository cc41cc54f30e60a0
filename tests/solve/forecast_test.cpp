#include "solve/forecast.h"

#include <gtest/gtest.h>

#include <numeric>

#include "solve/condensed_problem.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

/// The node graph of a chain 0 - 1 - ... - n-1.
fem::NodeGraph chain(std::int32_t n) {
    fem::NodeGraph graph{{0}, {}, {}};
    for (std::int32_t i = 0; i < n; ++i) {
        graph.columns.push_back(i);
        if (i + 1 < n) {
            graph.columns.push_back(i + 1);
        }
        graph.offsets.push_back(static_cast<std::int32_t>(graph.columns.size()));
    }
    return graph;
}

TEST(Forecast, CountsTheFactorOfAChain) {
    constexpr std::int32_t n = 10;
    std::vector<char> contact(n, 0);
    contact[n - 1] = 1;
    std::vector<std::int32_t> interior(n - 1);
    std::iota(interior.begin(), interior.end(), 0);
    const BalanceSize size = measure(chain(n), 2, contact, interior);
    EXPECT_EQ(size.unknowns, 20);
    EXPECT_EQ(size.contact_unknowns, 2);
    EXPECT_EQ(size.matrix_entries, 4 * (10 + 2 * 9));
    EXPECT_EQ(size.factor_entries, 4 * (10 + 9));  // in its order a chain has no fill
    // a column of c entries takes c^2 operations: nine of 2, one of 1
    EXPECT_EQ(size.factor_operations, 8 * (9 * 4 + 1));
}

// The factor that condensing then makes has the entries foreseen, but for what the forecast leaves out:
// blocks of nodes are counted whole (b^2 instead of b (b + 1) / 2 on the diagonal), prescribed unknowns count
// too, and CHOLMOD stores zeros to make its supernodes wide. Each is a lower-order part; a wrong order, or a
// factor of components, would be off by more than 2.
TEST(Forecast, IsWithinTwiceTheFactorThatIsMade) {
    for (const char* name : {"paper-isotropic", "box"}) {
        const support::Discretisation problem(support::repository_scene(
            name, {name == std::string("box") ? "mesh.cells=[9,9,9]" : "mesh.cells=[48,48]"}));
        const int d = problem.scene.dimension;
        fem::BlockMatrix matrix = fem::zero_matrix(problem.graph, d, d);
        for (std::int32_t node = 0; node < problem.graph.node_count(); ++node) {  // dominant: factors exist
            const auto first =
                static_cast<std::size_t>(problem.graph.offsets[static_cast<std::size_t>(node)]);
            for (int c = 0; c < d; ++c) {
                matrix.values[first * static_cast<std::size_t>(d * d) + static_cast<std::size_t>(c * d + c)] =
                    1;
            }
        }
        const auto contact = model::nodes_with(problem.surfaces, problem.space, &scene::Contact::compliance);
        InteriorOrders orders(problem.graph);
        const BalanceSize foreseen = measure(problem.graph, d, contact, orders.without(contact));
        Condensed condensed(std::move(orders));
        const std::vector<char> fixed(problem.node_count() * static_cast<std::size_t>(d), 0);
        const auto made = condensed.prepare({"momentum", matrix, fixed, contact, true, {1e-10, 10}});
        const double n_c = foreseen.contact_unknowns;
        const auto entries = static_cast<double>(made->factor_size().entries) + n_c * (n_c + 1) / 2;
        EXPECT_GT(foreseen.factor_entries, entries / 2) << name;
        EXPECT_LT(foreseen.factor_entries, entries * 2) << name;
    }
}

TEST(Forecast, ContactTooLargeToBeDenseIsSeenWithoutAFactor) {
    BalanceSize size;
    size.contact_unknowns = 70000;  // 2.45e9 numbers in a triangle: beyond 32 bits
    EXPECT_FALSE(can_condense(size));
    size.contact_unknowns = 1000;
    EXPECT_TRUE(can_condense(size));
    EXPECT_GE(condensed_cost(size, 0).bytes, 8.0 * 1000 * 1000);
}

}  // namespace
}  // namespace thermocontact::solve

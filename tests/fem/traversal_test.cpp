#include "fem/traversal.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "mesh/shapes.h"
#include "solve/workers.h"
#include "support/dense.h"

namespace thermocontact::fem {
namespace {

/// A space with matrices of every shape that a product takes.
struct Body {
    mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {4, 80}, "right"});
    Space space = make_space(mesh, 1);
    NodeGraph graph = make_node_graph(space);
    std::size_t nodes = static_cast<std::size_t>(graph.node_count());
    BlockMatrix scalar = random(1, 1, 1), blocks = random(2, 2, 2), wide = random(1, 2, 3),
                tall = random(2, 1, 4), scaled = scaled_identities();
    std::vector<double> one = support::random_numbers(nodes, 5), two = support::random_numbers(2 * nodes, 6);

    BlockMatrix random(int rows, int columns, unsigned seed) const {
        BlockMatrix matrix = zero_matrix(graph, rows, columns);
        matrix.values = support::random_numbers(matrix.values.size(), seed);
        if (rows != columns) {
            return matrix;
        }
        const auto size = static_cast<std::size_t>(rows);
        for (const std::int32_t first : graph.offsets) {  // diagonal blocks are symmetric
            if (static_cast<std::size_t>(first) < graph.columns.size() && size == 2) {
                double* block = &matrix.values[static_cast<std::size_t>(first) * 4];
                block[2] = block[1];
            }
        }
        return matrix;
    }
    BlockMatrix scaled_identities() const {
        BlockMatrix matrix = zero_matrix(graph, 2, 2);
        matrix.values = support::random_numbers(graph.columns.size(), 7);
        matrix.scaled_identities = true;
        return matrix;
    }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    return (support::as_vector(a) - support::as_vector(b)).cwiseAbs().maxCoeff();
}

/// Ranges of any size, by any number of threads, give what one loop over all nodes gives.
TEST(Traversal, MultipliesAsOneLoopDoes) {
    const Body body;
    // at most 7 nodes of 2 components couple with one: as many terms of size 1, in another order
    const double tolerance = 2 * 14 * 14 * std::numeric_limits<double>::epsilon();
    const std::vector<double> from = support::random_numbers(2 * body.nodes, 8);
    for (const std::int32_t size : {1 << 20, 200, 100, 60, 1}) {
        for (const int threads : {1, 3}) {
            solve::Workers workers(threads);
            Traversal traversal(
                body.graph, [&](int count, const auto& task) { workers.run(count, task); }, size);
            std::vector<double> scalar(body.nodes, 9), blocks(2 * body.nodes, 9), wide(body.nodes, 9),
                tall(2 * body.nodes, 9), scaled(2 * body.nodes, 9), absent(body.nodes, 9);
            double square = 9, scaled_square = 9;
            const Product products[] = {
                {.matrix = &body.scalar, .x = &body.one, .y = &scalar},
                {.matrix = &body.blocks, .x = &body.two, .y = &blocks, .factor = -0.5, .from = &from},
                {.matrix = &body.wide, .x = &body.two, .y = &wide},
                {.matrix = &body.tall, .x = &body.one, .y = &tall},
                {.matrix = &body.scaled, .x = &body.two, .y = &scaled},
                {.matrix = nullptr, .x = &body.one, .y = &absent},
                {.matrix = &body.blocks, .x = &body.two, .square = &square},
                {.matrix = &body.scaled, .x = &body.two, .square = &scaled_square}};
            for (int again = 0; again < 2; ++again) {
                traversal.multiply(products);
                EXPECT_LE(largest_difference(scalar, body.scalar.multiply(body.one)), tolerance);
                std::vector<double> expected = body.blocks.multiply(body.two);
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    expected[i] = from[i] - 0.5 * expected[i];
                }
                EXPECT_LE(largest_difference(blocks, expected), tolerance);
                EXPECT_LE(largest_difference(wide, body.wide.multiply(body.two)), tolerance);
                EXPECT_LE(largest_difference(tall, body.tall.multiply(body.one)), tolerance);
                EXPECT_LE(largest_difference(scaled, body.scaled.multiply(body.two)), tolerance);
                EXPECT_EQ(absent, std::vector<double>(body.nodes, 0.0));
                const auto nodes = static_cast<double>(body.nodes);
                EXPECT_NEAR(square, body.blocks.quadratic_form(body.two), nodes * tolerance);
                EXPECT_NEAR(scaled_square, body.scaled.quadratic_form(body.two), nodes * tolerance);
            }
        }
    }
}

TEST(Traversal, TheLastBitDoesNotDependOnTheThreads) {
    const Body body;
    std::vector<std::vector<double>> found;
    for (const int threads : {1, 2, 3}) {
        solve::Workers workers(threads);
        Traversal traversal(
            body.graph, [&](int count, const auto& task) { workers.run(count, task); }, 100);
        EXPECT_GT(traversal.range_count(), 1U);
        found.emplace_back(2 * body.nodes);
        traversal.multiply(
            std::vector<Product>{{.matrix = &body.blocks, .x = &body.two, .y = &found.back()}});
    }
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
}

/// Every node once; fewer ranges where they would share most of what they write.
TEST(Traversal, RangesCoverTheNodes) {
    const Body body;
    const auto serial = [](int count, const auto& task) {
        for (int i = 0; i < count; ++i) {
            task(i);
        }
    };
    for (const std::int32_t size : {1 << 20, 100, 1}) {
        const Traversal traversal(body.graph, serial, size);
        std::int32_t next = 0;
        traversal.each([&](NodeRange range, std::size_t) {
            EXPECT_EQ(range.begin, next);
            next = range.end;
        });
        EXPECT_EQ(next, body.graph.node_count());
        EXPECT_LT(traversal.range_count(), 20U);
    }
}

/// A process may have no part of the body.
TEST(Traversal, OfNoNodesDoesNothing) {
    const NodeGraph graph{{0}, {}, {}};
    const BlockMatrix matrix = zero_matrix(graph, 2, 2);
    Traversal traversal(graph, [](int count, const std::function<void(int)>& task) {
        for (int i = 0; i < count; ++i) {
            task(i);
        }
    });
    const std::vector<double> x;
    std::vector<double> y;
    double square = 1;
    traversal.multiply(std::array{Product{.matrix = &matrix, .x = &x, .y = &y},
                                  Product{.matrix = &matrix, .x = &x, .square = &square}});
    EXPECT_EQ(square, 0.0);
    EXPECT_EQ(traversal.range_count(), 0u);
    EXPECT_EQ(traversal.sum<double>([](NodeRange) { return 1.0; }), 0.0);
}

}  // namespace
}  // namespace thermocontact::fem

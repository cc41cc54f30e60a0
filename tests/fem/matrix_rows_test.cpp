#include "fem/matrix_rows.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesh/shapes.h"
#include "support/dense.h"

namespace thermocontact::fem {
namespace {

/// Rows in any order, of nodes with and without neighbours before them in the list, are those of the whole
/// product; what else is in the result stays.
TEST(MatrixRows, AreThoseOfTheProduct) {
    const mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {4, 5}, "right"});
    const Space space = make_space(mesh, 1);
    const NodeGraph graph = make_node_graph(space);
    for (const int components : {1, 2}) {
        BlockMatrix matrix = zero_matrix(graph, components, components);
        matrix.values = support::random_numbers(matrix.values.size(), 1);
        for (const std::int32_t first : graph.offsets) {  // diagonal blocks are symmetric
            if (const auto at = static_cast<std::size_t>(first) * 4;
                components == 2 && at < matrix.values.size()) {
                matrix.values[at + 2] = matrix.values[at + 1];
            }
        }
        const std::size_t size = space.nodes.size() * static_cast<std::size_t>(components);
        const auto x = support::random_numbers(size, 2), whole = matrix.multiply(x);
        const std::vector<std::int32_t> dofs{static_cast<std::int32_t>(size) - 1, 0, 7, 8, 13};
        std::vector<double> rows(size, 0.5), expected(size, 0.5);
        for (const std::int32_t dof : dofs) {
            expected[static_cast<std::size_t>(dof)] = whole[static_cast<std::size_t>(dof)];
        }
        MatrixRows(matrix, dofs).multiply(x, rows);
        // at most 14 terms of size 1 a row, in another order
        const double tolerance = 2 * 14 * 14 * std::numeric_limits<double>::epsilon();
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_NEAR(rows[i], expected[i], tolerance) << i;
        }
    }
}

}  // namespace
}  // namespace thermocontact::fem

#include "fem/plane_rows.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesh/shapes.h"
#include "solve/workers.h"
#include "support/dense.h"

namespace thermocontact::fem {
namespace {

struct Case {
    std::string cell;
    int degree;
};

/// A body whose cells differ, so that quadrilaterals are not affine.
struct Body {
    mesh::Mesh mesh;
    Space space;
    NodeGraph graph;
    std::vector<double> u, w;

    explicit Body(const Case& kind)
        : mesh(distorted(kind.cell)), space(make_space(mesh, kind.degree)), graph(make_node_graph(space)) {
        u = support::random_numbers(2 * space.nodes.size(), 1);
        w = support::random_numbers(2 * space.nodes.size(), 2);
    }

    static mesh::Mesh distorted(const std::string& cell) {
        mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 2}, {3, 40}, "right", cell});
        for (mesh::Point& x : mesh.points) {
            x = {x[0] + 0.1 * x[1] * x[0] * x[0], x[1] + 0.05 * x[0] * x[1] * x[1], 0};
        }
        return mesh;
    }

    BlockMatrix matrix(const std::string& form, const std::string& constant, const Isotropic& C) const {
        const Constants constants{
            {constant, {C.trace + C.shear, C.trace, 0, C.trace, C.trace + C.shear, 0, 0, 0, C.shear / 2}}};
        return assemble_matrix({find_kernel(form, mesh.cell, space.element.degree), mesh, constants}, space,
                               graph, 2, 2);
    }
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    return (support::as_vector(a) - support::as_vector(b)).cwiseAbs().maxCoeff();
}

class PlaneRows : public testing::TestWithParam<Case> {};

/// The products are those of the matrices that the forms make, each assembled by itself, whatever the ranges
/// and the threads, whose number changes no bit.
TEST_P(PlaneRows, EqualMatricesOfTheirOwn) {
    const Body body(GetParam());
    const Isotropic E{-0.3, 1.9}, V{10, 4};
    const BlockMatrix divergences = body.matrix("elasticity.stiffness", "E", {1, 0}),
                      stiffness = body.matrix("elasticity.stiffness", "E", E),
                      damping = body.matrix("viscosity.damping", "Visc", V),
                      norm = body.matrix("norms.strains", "", {0, 1});
    // at most 25 nodes couple with one: sums of 50 terms, whose entries are sums over up to 6 cells of up to
    // 9 points, by either way; each rounding counts once for the largest entry of a matrix
    constexpr double terms = 50, roundings = terms + 2 * 6 * 9;
    const auto tolerance = [&](const BlockMatrix& matrix) {
        return terms * roundings * std::numeric_limits<double>::epsilon() *
               support::as_vector(matrix.values).cwiseAbs().maxCoeff();
    };
    EXPECT_LE(largest_difference(isotropic_matrix(divergences, E).values, stiffness.values),
              tolerance(stiffness));
    const auto nodes = static_cast<double>(body.space.nodes.size());
    std::vector<double> first;
    for (const std::int32_t size : {1 << 20, 100, 1}) {
        for (const int threads : {1, 3}) {
            solve::Workers workers(threads);
            Traversal traversal(
                body.graph, [&](int count, const auto& task) { workers.run(count, task); }, size);
            std::vector<double> elastic(body.u.size(), 9), viscous(body.u.size(), 9);
            double square = 9;
            const PlaneProducts products{&divergences, E, V, &body.u, &body.w, &elastic, &viscous, &square};
            traversal.run(std::array{pass_of(products)});
            EXPECT_LE(largest_difference(elastic, stiffness.multiply(body.u)), tolerance(stiffness));
            EXPECT_LE(largest_difference(viscous, damping.multiply(body.w)), tolerance(damping));
            EXPECT_NEAR(square, norm.quadratic_form(body.u), nodes * tolerance(norm));
            std::vector<double> found = elastic;
            found.insert(found.end(), viscous.begin(), viscous.end());
            found.push_back(square);
            EXPECT_TRUE(threads == 1 || found == first);
            first = found;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, PlaneRows,
                         testing::Values(Case{"simplex", 1}, Case{"simplex", 2}, Case{"tensor", 1},
                                         Case{"tensor", 2}));

}  // namespace
}  // namespace thermocontact::fem

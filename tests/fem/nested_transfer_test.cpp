#include "fem/nested_transfer.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "mesh/shapes.h"

namespace thermocontact::fem {
namespace {

mesh::Forest base_of(int dimension) {
    const scene::MeshSpec spec = dimension == 2
                                     ? scene::MeshSpec{"rectangle", {0, 0}, {1, 0.5}, {2, 1}, "crossed"}
                                     : scene::MeshSpec{"box", {0, 0, 0}, {1, 0.5, 1}, {1, 1, 1}, ""};
    return mesh::Forest(std::make_shared<const mesh::Mesh>(mesh::make_mesh(spec)));
}

mesh::Forest at_random(const mesh::Forest& forest, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<int> levels;
    for (const std::int32_t leaf : forest.leaves()) {
        levels.push_back(random() % 3 == 0 ? forest.at(leaf).level + 3 : 0);
    }
    return forest.with_levels(levels);
}

/// Two components, polynomials of the degree.
std::vector<double> polynomial(const Space& space, int degree) {
    std::vector<double> values;
    for (const mesh::Point& x : space.nodes) {
        const double linear = 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2];
        values.push_back(degree == 1 ? linear : linear * (x[1] - x[2] + x[0]));
        values.push_back(degree == 1 ? x[0] - x[2] : x[0] * x[0] - x[1] * x[2]);
    }
    return values;
}

std::vector<double> noise(std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<double> values(count);
    for (double& value : values) {
        value = number(random);
    }
    return values;
}

class EveryDegree : public testing::TestWithParam<std::pair<int, int>> {};

/// Forests neither of which is finer than the other: what both spaces contain is carried over.
TEST_P(EveryDegree, KeepsPolynomials) {
    const auto [dimension, degree] = GetParam();
    const mesh::Forest base = base_of(dimension);
    const ForestSpace one(at_random(at_random(base, 1), 2), degree), other(at_random(base, 5), degree);
    ASSERT_NE(one.forest.bisections(), other.forest.bisections());
    for (const auto& [from, to] : {std::pair(&one, &other), {&other, &one}}) {
        const auto carried = NestedTransfer(*from, *to)(polynomial(from->space, degree), 2);
        const auto exact = polynomial(to->space, degree);
        ASSERT_EQ(carried.size(), exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            EXPECT_NEAR(carried[i], exact[i], 20 * 2.3e-16 * 5) << i;  // at most ten terms of size 5
        }
    }
}

/// To a finer mesh and back: the same to the last bit, as the nodes of the coarse one are nodes of the finer.
TEST_P(EveryDegree, ThereAndBackChangesNothing) {
    const auto [dimension, degree] = GetParam();
    const ForestSpace coarse(at_random(base_of(dimension), 1), degree);
    std::vector<int> levels;
    for (const std::int32_t leaf : coarse.forest.leaves()) {
        levels.push_back(coarse.forest.at(leaf).level + leaf % 4);
    }
    const ForestSpace fine(coarse.forest.with_levels(levels), degree);
    ASSERT_GT(fine.space.nodes.size(), coarse.space.nodes.size());
    const auto values = noise(coarse.space.nodes.size() * 3);
    EXPECT_EQ(NestedTransfer(fine, coarse)(NestedTransfer(coarse, fine)(values, 3), 3), values);
    EXPECT_THROW(NestedTransfer(fine, coarse)(values, 3), std::logic_error) << "values of the other mesh";
}

/// On the finer mesh a function of the coarser is itself: refined again, it is what it is refined at once.
TEST_P(EveryDegree, IsExactWhereFiner) {
    const auto [dimension, degree] = GetParam();
    const ForestSpace coarse(base_of(dimension), degree);
    const ForestSpace between(at_random(coarse.forest, 1), degree);
    const ForestSpace fine(
        at_random(at_random(between.forest, 2), 3)
            .with_levels(std::vector<int>(
                static_cast<std::size_t>(at_random(at_random(between.forest, 2), 3).cell_count()), 6)),
        degree);
    const auto values = noise(coarse.space.nodes.size());
    const auto at_once = NestedTransfer(coarse, fine)(values, 1);
    const auto in_two = NestedTransfer(between, fine)(NestedTransfer(coarse, between)(values, 1), 1);
    for (std::size_t i = 0; i < at_once.size(); ++i) {
        EXPECT_NEAR(at_once[i], in_two[i], 20 * 2.3e-16 * 2) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Spaces, EveryDegree,
                         testing::Values(std::pair(2, 1), std::pair(2, 2), std::pair(3, 1), std::pair(3, 2)));

}  // namespace
}  // namespace thermocontact::fem

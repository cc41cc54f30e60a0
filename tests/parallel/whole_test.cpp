#include "parallel/whole.h"

#include <gtest/gtest.h>

#include <bit>

#include "support/dense.h"
#include "support/scenes.h"

namespace thermocontact::parallel {
namespace {

/// One of several processes, played one after the other: keeps what it would have added to the sum.
class Played final : public Team {
  public:
    using Team::max;
    using Team::sum;
    Played(int rank, int size) : rank_(rank), size_(size) {}
    int rank() const override { return rank_; }
    int size() const override { return size_; }
    void sum(std::span<double>) const override {}
    void max(std::span<double>) const override {}
    std::vector<Message> deliver(const std::vector<Message>&) const override { return {}; }
    void exchange(std::span<const Exchange>) const override {}

  private:
    int rank_, size_;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>,
                              std::bit_cast<std::uint64_t, double>);
}

/// Every node is told by exactly one process, and each finds its own again, to the sign of zero.
TEST(Whole, ThereAndBackOnAnyNumberOfProcesses) {
    const scene::Scene scene = support::repository_scene("paper", {"mesh.cells=[5,4]", "space.degree=2"});
    const mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    const fem::Space space = fem::make_space(mesh, scene.degree);
    for (const std::size_t components : {1U, 2U}) {
        std::vector<double> values = support::random_numbers(space.nodes.size() * components);
        values[3] = -0.0;
        values[4] = 0.0;
        for (const int processes : {1, 2, 3, 7}) {
            std::vector<double> sum(values.size(), -0.0);
            for (int rank = 0; rank < processes; ++rank) {
                const Part part = take_part(mesh, space, processes, rank);
                const std::vector<double> mine = from_whole(part.numbers, values);
                ASSERT_EQ(mine.size(), part.space.nodes.size() * components);
                const std::vector<double> told = to_whole(part.numbers, Played(rank, processes), mine);
                ASSERT_EQ(told.size(), values.size());
                for (std::size_t i = 0; i < sum.size(); ++i) {
                    sum[i] += told[i];
                }
                for (std::size_t i = 0; i < part.space.nodes.size(); ++i) {
                    const auto node = static_cast<std::size_t>(part.numbers.whole[i]);
                    EXPECT_EQ(part.space.nodes[i], space.nodes[node]);
                    EXPECT_EQ(mine[i * components], values[node * components]);
                }
            }
            EXPECT_TRUE(same_bits(sum, values)) << processes << " processes";
        }
    }
}

}  // namespace
}  // namespace thermocontact::parallel

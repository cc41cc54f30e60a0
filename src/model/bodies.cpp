#include "model/bodies.h"

#include <algorithm>
#include <numeric>

namespace thermocontact::model {
namespace {

/// Nodes that are connected within the part, by one node of each set.
class Sets {
  public:
    explicit Sets(std::size_t nodes) : above_(nodes) { std::iota(above_.begin(), above_.end(), 0); }

    std::int32_t find(std::int32_t node) {
        while (above(node) != node) {
            node = above(node) = above(above(node));
        }
        return node;
    }
    void unite(std::int32_t a, std::int32_t b) { above(find(a)) = find(b); }

  private:
    std::int32_t& above(std::int32_t node) { return above_[static_cast<std::size_t>(node)]; }

    std::vector<std::int32_t> above_;
};

}  // namespace

Bodies find_bodies(const fem::Space& space, const parallel::NodeNumbers& numbers,
                   const parallel::Team& team) {
    const std::size_t nodes = space.nodes.size();
    Sets sets(nodes);
    const auto width = static_cast<std::size_t>(space.dofmap.nodes_per_cell);
    for (std::size_t i = 0; i < space.dofmap.cell_nodes.size(); ++i) {
        sets.unite(space.dofmap.cell_nodes[i - i % width], space.dofmap.cell_nodes[i]);
    }
    // each set takes the largest label that one of its nodes has on any process, until none changes
    std::vector<double> labels(nodes, -1.0), whole;
    for (bool changed = true; changed;) {
        whole.assign(static_cast<std::size_t>(numbers.total()), -1.0);
        std::vector<double> of_sets = labels;
        for (std::size_t i = 0; i < nodes; ++i) {
            double& label = of_sets[static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(i)))];
            label = std::max({label, labels[i], static_cast<double>(numbers.whole[i])});
        }
        for (std::size_t i = 0; i < nodes; ++i) {
            whole[static_cast<std::size_t>(numbers.whole[i])] =
                of_sets[static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(i)))];
        }
        team.max(whole);
        changed = false;
        for (std::size_t i = 0; i < nodes; ++i) {
            const double label = whole[static_cast<std::size_t>(numbers.whole[i])];
            changed = changed || label != labels[i];
            labels[i] = label;
        }
        changed = team.any(changed);
    }
    std::ranges::sort(whole);
    whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
    Bodies bodies{whole.size(), {}};
    for (const double label : labels) {
        const auto place = std::ranges::lower_bound(whole, label);
        bodies.of_nodes.push_back(static_cast<std::int32_t>(place - whole.begin()));
    }
    return bodies;
}

}  // namespace thermocontact::model

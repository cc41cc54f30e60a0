#include "solve/grid_dissection.h"

#include <algorithm>
#include <optional>

namespace thermocontact::solve {
namespace {

using mesh::GridPlace;

/// Places from `lower` to `upper`, both among them.
struct Box {
    GridPlace lower, upper;
};

struct Plane {
    std::size_t axis;
    std::int32_t place;
};

/// In the middle of the longest axis; none where no plane has places on both of its sides.
std::optional<Plane> middle(const Box& box) {
    std::optional<Plane> result;
    std::int32_t longest = 0;
    for (std::size_t axis = 0; axis < box.lower.size(); ++axis) {
        const std::int32_t lower = box.lower[axis], upper = box.upper[axis];
        const std::int32_t place = (lower + upper + 2) / 4 * 2;  // the even one next to the middle
        if (upper - lower > longest && lower < place && place < upper) {
            longest = upper - lower;
            result = Plane{axis, place};
        }
    }
    return result;
}

class Dissection {
  public:
    explicit Dissection(std::span<const GridPlace> places) : places_(places) {}

    void order(std::span<std::int32_t> nodes, const Box& box) const {
        const std::optional<Plane> plane = middle(box);
        if (!plane || nodes.size() < 2) {
            std::ranges::stable_sort(nodes, {}, [this](std::int32_t node) { return planes_of(node); });
            return;
        }
        const auto along = [this, axis = plane->axis](std::int32_t node) { return of(node)[axis]; };
        const auto rest = std::ranges::stable_partition(
            nodes, [&](std::int32_t node) { return along(node) < plane->place; });
        const auto on_plane = std::ranges::stable_partition(
            rest, [&](std::int32_t node) { return along(node) > plane->place; });
        Box below = box, above = box;
        below.upper[plane->axis] = plane->place - 1;
        above.lower[plane->axis] = plane->place + 1;
        order({nodes.begin(), rest.begin()}, below);
        order({rest.begin(), on_plane.begin()}, above);
    }

  private:
    const GridPlace& of(std::int32_t node) const { return places_[static_cast<std::size_t>(node)]; }

    /// On how many planes a node lies: those inside of cells couple with the fewest others.
    std::ptrdiff_t planes_of(std::int32_t node) const {
        return std::ranges::count_if(of(node), [](std::int32_t place) { return place % 2 == 0; });
    }

    std::span<const GridPlace> places_;
};

}  // namespace

std::vector<std::int32_t> grid_dissection(std::span<const GridPlace> places,
                                          std::vector<std::int32_t> nodes) {
    if (nodes.empty()) {
        return nodes;
    }
    Box box{places[static_cast<std::size_t>(nodes.front())], places[static_cast<std::size_t>(nodes.front())]};
    for (const std::int32_t node : nodes) {
        for (std::size_t axis = 0; axis < box.lower.size(); ++axis) {
            const std::int32_t place = places[static_cast<std::size_t>(node)][axis];
            box.lower[axis] = std::min(box.lower[axis], place);
            box.upper[axis] = std::max(box.upper[axis], place);
        }
    }
    Dissection(places).order(nodes, box);
    return nodes;
}

}  // namespace thermocontact::solve

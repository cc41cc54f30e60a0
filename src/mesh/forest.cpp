#include "mesh/forest.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "error.h"
#include "mesh/marked_edges.h"

namespace thermocontact::mesh {
namespace {

std::uint64_t edge_key(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32U | static_cast<std::uint64_t>(std::max(a, b));
}

}  // namespace

Forest::Forest(std::shared_ptr<const Mesh> base) : base_(std::move(base)), points_(base_->points) {
    plant();
    number_leaves();
}

Forest::Forest(std::shared_ptr<const Mesh> base, const Bisections& bisections)
    : base_(std::move(base)), points_(base_->points) {
    plant();
    const auto refuse = [] { throw SceneError("its bisections do not fit the mesh"); };
    auto next = bisections.begin();
    std::vector<std::int32_t> stack;
    for (std::int32_t root = 0; root < root_count(); ++root) {
        stack.assign(1, root);
        while (!stack.empty()) {
            const std::int32_t cell = stack.back();
            stack.pop_back();
            if (next == bisections.end()) {
                refuse();
            }
            if (*next++ != 0) {
                bisect(cell);
                stack.push_back(at(cell).child + 1);
                stack.push_back(at(cell).child);
            }
        }
    }
    const auto hangs = [&](const Cell& cell) { return cell.child < 0 && has_hanging_node(cell); };
    if (next != bisections.end() || std::ranges::any_of(cells_, hangs)) {
        refuse();
    }
    number_leaves();
}

/// The trees of one cell each.
void Forest::plant() {
    const auto width = static_cast<std::size_t>(base_->vertices_per_cell);
    cells_.resize(static_cast<std::size_t>(base_->cell_count()));
    std::vector<std::array<std::int32_t, 4>> boundaries(cells_.size(), {-1, -1, -1, -1});
    for (const Facet& facet : base_->facets) {  // facet i of a simplex is opposite to its vertex i
        boundaries[static_cast<std::size_t>(facet.cell)][static_cast<std::size_t>(facet.local)] =
            facet.boundary;
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        Cell& cell = cells_[i];
        cell.root = static_cast<std::int32_t>(i);
        const auto vertices = base_->vertices_of(cell.root);
        const MarkedEdges marked = mark_longest(*base_, vertices);
        for (std::size_t v = 0; v < width; ++v) {
            const auto place = static_cast<std::size_t>(marked.order[v]);
            cell.vertices[v] = vertices[place];
            cell.boundaries[v] = boundaries[i][place];
        }
        cell.left_out = marked.left_out;
    }
}

std::int32_t Forest::middle(std::int32_t a, std::int32_t b) {
    const auto number = static_cast<std::int32_t>(points_.size());
    const auto [entry, is_new] = middles_.try_emplace(edge_key(a, b), number);
    if (is_new) {
        const Point &x = points_[static_cast<std::size_t>(a)], &y = points_[static_cast<std::size_t>(b)];
        points_.push_back({(x[0] + y[0]) / 2, (x[1] + y[1]) / 2, (x[2] + y[2]) / 2});
    }
    return entry->second;
}

bool Forest::has_hanging_node(const Cell& cell) const {
    const auto width = static_cast<std::size_t>(vertices_per_cell());
    for (std::size_t i = 0; i < width; ++i) {
        for (std::size_t j = i + 1; j < width; ++j) {
            if (middles_.contains(edge_key(cell.vertices[i], cell.vertices[j]))) {
                return true;
            }
        }
    }
    return false;
}

void Forest::bisect(std::int32_t number) {
    const Cell parent = at(number);
    const std::int32_t m = middle(parent.vertices[0], parent.vertices[1]);
    const auto first = static_cast<std::int32_t>(cells_.size());
    cells_[static_cast<std::size_t>(number)].child = first;
    for (const std::size_t kept : {std::size_t{0}, std::size_t{1}}) {
        const HalfOfCell half = half_of(parent.left_out, parent.flag, kept, vertices_per_cell());
        Cell child;
        child.root = parent.root;
        child.level = parent.level + 1;
        child.left_out = half.left_out;
        child.flag = half.flag;
        for (std::size_t v = 0; v < static_cast<std::size_t>(vertices_per_cell()); ++v) {
            const auto place = static_cast<std::size_t>(half.order[v]);
            if (half.order[v] == middle_of_edge) {  // opposite: the facet that lacks the other end
                child.vertices[v] = m;
                child.boundaries[v] = parent.boundaries[1 - kept];
            } else {
                child.vertices[v] = parent.vertices[place];
                child.boundaries[v] = place == kept ? -1 : parent.boundaries[place];
            }
        }
        cells_.push_back(child);
    }
}

Forest Forest::with_levels(const std::vector<int>& levels) const {
    // of each cell of the trees the largest number wanted within it
    std::vector<int> wanted(cells_.size(), 0);
    for (std::size_t i = cells_.size(); i-- > 0;) {  // children come after their parents
        const Cell& cell = cells_[i];
        const auto child = static_cast<std::size_t>(cell.child);
        wanted[i] = cell.child < 0 ? levels[static_cast<std::size_t>(cell.leaf)]
                                   : std::max(wanted[child], wanted[child + 1]);
    }
    Forest result(base_);
    std::vector<std::int32_t> here(result.cells_.size());  // [its cells]: the cell of this forest they lie in
    std::vector<std::int32_t> candidates(here.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
        here[i] = candidates[i] = static_cast<std::int32_t>(i);
    }
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::int32_t> next;
        for (const std::int32_t number : candidates) {
            const Cell cell = result.at(number);
            const std::int32_t mine = here[static_cast<std::size_t>(number)];
            if (cell.level >= wanted[static_cast<std::size_t>(mine)] && !result.has_hanging_node(cell)) {
                next.push_back(number);
                continue;
            }
            changed = true;
            result.bisect(number);
            const std::int32_t child = result.at(number).child, below = at(mine).child;
            here.insert(here.end(), {below < 0 ? mine : below, below < 0 ? mine : below + 1});
            next.insert(next.end(), {child, child + 1});
        }
        candidates = std::move(next);
    }
    return {base_, result.bisections()};
}

std::vector<std::int32_t> Forest::leaves() const {
    std::vector<std::int32_t> result, stack;
    for (std::int32_t root = 0; root < root_count(); ++root) {
        stack.assign(1, root);
        while (!stack.empty()) {
            const std::int32_t cell = stack.back();
            stack.pop_back();
            if (at(cell).child < 0) {
                result.push_back(cell);
            } else {
                stack.insert(stack.end(), {at(cell).child + 1, at(cell).child});
            }
        }
    }
    return result;
}

void Forest::number_leaves() {
    for (const std::int32_t cell : leaves()) {
        cells_[static_cast<std::size_t>(cell)].leaf = leaf_count_++;
    }
}

Bisections Forest::bisections() const {
    Bisections result;
    std::vector<std::int32_t> stack;
    for (std::int32_t root = 0; root < root_count(); ++root) {
        stack.assign(1, root);
        while (!stack.empty()) {
            const Cell& cell = at(stack.back());
            stack.pop_back();
            result.push_back(cell.child < 0 ? 0 : 1);
            if (cell.child >= 0) {
                stack.insert(stack.end(), {cell.child + 1, cell.child});
            }
        }
    }
    return result;
}

int Forest::deepest() const {
    return std::ranges::max_element(cells_, {}, &Cell::level)->level;
}

Mesh Forest::mesh() const {
    if (cells_.size() == static_cast<std::size_t>(root_count())) {
        return *base_;
    }
    Mesh result = *base_;
    result.points = points_;
    result.cells.clear();
    result.facets.clear();
    result.cell_regions.clear();
    const auto width = static_cast<std::size_t>(vertices_per_cell());
    for (const std::int32_t number : leaves()) {
        const Cell& cell = at(number);
        result.cells.insert(result.cells.end(), cell.vertices.begin(),
                            cell.vertices.begin() + static_cast<std::ptrdiff_t>(width));
        if (!base_->cell_regions.empty()) {
            result.cell_regions.push_back(base_->cell_regions[static_cast<std::size_t>(cell.root)]);
        }
        for (std::size_t v = 0; v < width; ++v) {
            if (cell.boundaries[v] >= 0) {
                result.facets.push_back({cell.leaf, static_cast<std::int32_t>(v), cell.boundaries[v]});
            }
        }
    }
    std::ranges::stable_sort(result.facets, {}, &Facet::boundary);
    return result;
}

}  // namespace thermocontact::mesh

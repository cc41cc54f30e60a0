#include "fem/nested_transfer.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace thermocontact::fem {
namespace {

using mesh::Forest;
using Barycentric = std::array<double, 4>;   ///< by the places of a forest's cell
using Corners = std::array<Barycentric, 4>;  ///< of the vertices of a cell within another one
using Row = std::vector<std::pair<std::int32_t, double>>;

std::size_t place_of(const Forest::Cell& cell, std::int32_t vertex) {
    return static_cast<std::size_t>(std::ranges::find(cell.vertices, vertex) - cell.vertices.begin());
}

/// The corners of a half of `parent`, in the cell that those of `parent` are given in.
Corners corners_of_half(const Forest::Cell& parent, const Forest::Cell& half, const Corners& corners) {
    Corners result{};
    for (std::size_t v = 0; v < corners.size() && half.vertices[v] >= 0; ++v) {
        const std::size_t place = place_of(parent, half.vertices[v]);
        for (std::size_t i = 0; i < 4; ++i) {
            result[v][i] = place < 4 ? corners[place][i] : (corners[0][i] + corners[1][i]) / 2;
        }
    }
    return result;
}

/// Walks both forests' trees together and collects, for each node of the new space, which nodes of the old
/// one it takes its value from.
class Walk {
  public:
    Walk(const ForestSpace& from, const ForestSpace& to)
        : from_(&from),
          to_(&to),
          width_(static_cast<std::size_t>(from.forest.vertices_per_cell())),
          rows_(to.space.nodes.size()) {
        Corners own{};
        for (std::size_t v = 0; v < width_; ++v) {
            own[v][v] = 1;
        }
        for (std::int32_t root = 0; root < from.forest.root_count(); ++root) {
            visit(root, root, own);
        }
    }

    const std::vector<Row>& rows() const { return rows_; }

  private:
    /// `corners`: of the new cell in the old one, which it lies in (or is).
    void visit(std::int32_t old_cell, std::int32_t new_cell, const Corners& corners) {
        const Forest::Cell &was = from_->forest.at(old_cell), &is = to_->forest.at(new_cell);
        if (is.child < 0) {
            take_nodes(old_cell, is, corners);
            return;
        }
        for (std::int32_t half = 0; half < 2; ++half) {
            if (was.child < 0) {
                visit(old_cell, is.child + half,
                      corners_of_half(is, to_->forest.at(is.child + half), corners));
            } else {  // the same cell in both: its half is
                visit(was.child + half, is.child + half, corners);
            }
        }
    }

    void take_nodes(std::int32_t old_cell, const Forest::Cell& leaf, const Corners& corners) {
        const auto vertices = to_->mesh.vertices_of(leaf.leaf);
        const auto nodes = to_->space.dofmap.of(leaf.leaf);
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            Row& row = rows_[static_cast<std::size_t>(nodes[n])];
            if (!row.empty()) {
                continue;
            }
            Barycentric x{};
            for (std::size_t v = 0; v < width_; ++v) {
                const double weight = to_->space.element.vertex_weights[n][v];
                const Barycentric& corner = corners[place_of(leaf, vertices[v])];
                for (std::size_t i = 0; i < width_; ++i) {
                    x[i] += weight * corner[i];
                }
            }
            row = evaluation(old_cell, x);
        }
    }

    /// The shape functions at x of the leaf below `cell` that has it.
    Row evaluation(std::int32_t cell, Barycentric x) const {
        while (from_->forest.at(cell).child >= 0) {
            const Forest::Cell& parent = from_->forest.at(cell);
            const std::int32_t kept = x[0] >= x[1] ? 0 : 1;
            const auto end = static_cast<std::size_t>(kept), other = 1 - end;
            cell = parent.child + kept;
            const Forest::Cell& half = from_->forest.at(cell);
            Barycentric below{};
            for (std::size_t v = 0; v < width_; ++v) {
                const std::size_t place = place_of(parent, half.vertices[v]);
                below[v] = place == end ? x[end] - x[other] : place < 4 ? x[place] : 2 * x[other];
            }
            x = below;
        }
        return shape_functions(from_->forest.at(cell), x);
    }

    Row shape_functions(const Forest::Cell& leaf, const Barycentric& x) const {
        const LagrangeElement& element = from_->space.element;
        const auto vertices = from_->mesh.vertices_of(leaf.leaf);
        const auto nodes = from_->space.dofmap.of(leaf.leaf);
        const auto coordinate = [&](int v) {
            return x[place_of(leaf, vertices[static_cast<std::size_t>(v)])];
        };
        Row row;
        const auto add = [&](int local, double weight) {
            if (weight != 0) {
                row.emplace_back(nodes[static_cast<std::size_t>(local)], weight);
            }
        };
        for (int v = 0; v < static_cast<int>(width_); ++v) {
            const double l = coordinate(v);
            add(element.entities[0][static_cast<std::size_t>(v)].front(),
                element.degree == 1 ? l : l * (2 * l - 1));
        }
        for (std::size_t e = 0; element.degree == 2 && e < element.topology[1].size(); ++e) {
            const std::vector<int>& ends = element.topology[1][e];
            add(element.entities[1][e].front(), 4 * coordinate(ends[0]) * coordinate(ends[1]));
        }
        return row;
    }

    const ForestSpace *from_, *to_;
    std::size_t width_;
    std::vector<Row> rows_;
};

}  // namespace

NestedTransfer::NestedTransfer(const ForestSpace& from, const ForestSpace& to)
    : old_nodes_(from.space.nodes.size()) {
    const Walk walk(from, to);
    for (const Row& row : walk.rows()) {
        for (const auto& [node, weight] : row) {
            nodes_.push_back(node);
            weights_.push_back(weight);
        }
        first_.push_back(static_cast<std::int32_t>(nodes_.size()));
    }
}

std::vector<double> NestedTransfer::operator()(const std::vector<double>& values, int components) const {
    const auto width = static_cast<std::size_t>(components);
    if (values.size() != old_nodes_ * width) {
        throw std::logic_error("values of another mesh");
    }
    std::vector<double> result((first_.size() - 1) * width, 0.0);
    for (std::size_t node = 0; node + 1 < first_.size(); ++node) {
        for (auto i = static_cast<std::size_t>(first_[node]); i < static_cast<std::size_t>(first_[node + 1]);
             ++i) {
            for (std::size_t c = 0; c < width; ++c) {
                result[node * width + c] +=
                    weights_[i] * values[static_cast<std::size_t>(nodes_[i]) * width + c];
            }
        }
    }
    return result;
}

}  // namespace thermocontact::fem

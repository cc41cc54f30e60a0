#include "fem/space.h"

#include <algorithm>
#include <unordered_map>

namespace thermocontact::fem {
namespace {

/// Gives each entity of the mesh, named by two of its vertices, the next free node.
class EntityNumbering {
  public:
    explicit EntityNumbering(std::int32_t first) : next_(first) {}

    std::int32_t operator()(std::int32_t p, std::int32_t q) {
        const auto key =
            (static_cast<std::uint64_t>(std::min(p, q)) << 32U) | static_cast<std::uint64_t>(std::max(p, q));
        const auto [entry, is_new] = numbers_.try_emplace(key, next_);
        next_ += is_new ? 1 : 0;
        return entry->second;
    }

    std::int32_t count() const { return next_; }

  private:
    std::unordered_map<std::uint64_t, std::int32_t> numbers_;
    std::int32_t next_;
};

/// Two vertices that name an entity in every cell that has it: the ends of an edge; of a quadrilateral
/// (vertices a, b, c, d; diagonals a-d and b-c) the diagonal that holds the smallest.
std::pair<std::int32_t, std::int32_t> name_of(const std::vector<int>& local, const std::int32_t* vertices) {
    if (local.size() == 2) {
        return {vertices[local[0]], vertices[local[1]]};
    }
    const std::pair diagonal{vertices[local[0]], vertices[local[3]]};
    const std::pair other{vertices[local[1]], vertices[local[2]]};
    return std::min(diagonal.first, diagonal.second) < std::min(other.first, other.second) ? diagonal : other;
}

/// Numbers the nodes inside the edges, or the quadrilateral faces, of all cells; returns how many nodes there
/// are then.
std::int32_t number_entities(const mesh::Mesh& mesh, const LagrangeElement& element, std::size_t dimension,
                             Dofmap& dofmap) {
    EntityNumbering numbers(dofmap.node_count);
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::int32_t* vertices = mesh.vertices_of(cell).data();
        std::int32_t* nodes = &dofmap.cell_nodes[static_cast<std::size_t>(cell) *
                                                 static_cast<std::size_t>(dofmap.nodes_per_cell)];
        for (std::size_t e = 0; e < element.entities[dimension].size(); ++e) {
            if (!element.entities[dimension][e].empty()) {
                const auto [p, q] = name_of(element.topology[dimension][e], vertices);
                nodes[element.entities[dimension][e].front()] = numbers(p, q);
            }
        }
    }
    return numbers.count();
}

Dofmap number_nodes(const mesh::Mesh& mesh, const LagrangeElement& element) {
    const auto per_cell = static_cast<std::size_t>(element.node_count);
    const auto cells = static_cast<std::size_t>(mesh.cell_count());
    Dofmap dofmap{element.node_count, static_cast<std::int32_t>(mesh.points.size()),
                  std::vector<std::int32_t>(cells * per_cell)};
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto vertices = mesh.vertices_of(static_cast<std::int32_t>(cell));
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            dofmap.cell_nodes[cell * per_cell + static_cast<std::size_t>(element.entities[0][v].front())] =
                vertices[v];
        }
    }
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t dimension = 1; element.degree == 2 && dimension < d; ++dimension) {
        dofmap.node_count = number_entities(mesh, element, dimension, dofmap);
    }
    if (const auto& interior = element.entities[d].front(); !interior.empty()) {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            dofmap.cell_nodes[cell * per_cell + static_cast<std::size_t>(interior.front())] =
                dofmap.node_count++;
        }
    }
    return dofmap;
}

std::vector<mesh::Point> node_coordinates(const mesh::Mesh& mesh, const LagrangeElement& element,
                                          const Dofmap& dofmap) {
    std::vector<mesh::Point> coordinates(static_cast<std::size_t>(dofmap.node_count));
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto vertices = mesh.vertices_of(cell);
        const auto nodes = dofmap.of(cell);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            mesh::Point x{};
            for (std::size_t v = 0; v < element.vertex_weights[node].size(); ++v) {
                const mesh::Point& vertex = mesh.points[static_cast<std::size_t>(vertices[v])];
                for (std::size_t i = 0; i < 3; ++i) {
                    x[i] += element.vertex_weights[node][v] * vertex[i];
                }
            }
            coordinates[static_cast<std::size_t>(nodes[node])] = x;
        }
    }
    return coordinates;
}

Dofmap number_cells(std::int32_t count) {
    Dofmap dofmap{1, count, std::vector<std::int32_t>(static_cast<std::size_t>(count))};
    for (std::int32_t cell = 0; cell < count; ++cell) {
        dofmap.cell_nodes[static_cast<std::size_t>(cell)] = cell;
    }
    return dofmap;
}

}  // namespace

std::vector<std::int32_t> Space::facet_nodes(const mesh::Facet& facet) const {
    std::vector<std::int32_t> result;
    for (const int local : element.facet_nodes[static_cast<std::size_t>(facet.local)]) {
        result.push_back(dofmap.of(facet.cell)[static_cast<std::size_t>(local)]);
    }
    return result;
}

namespace {

std::vector<std::vector<std::int32_t>> find_boundary_nodes(const mesh::Mesh& mesh, const Space& space) {
    std::vector<std::vector<std::int32_t>> result(mesh.boundary_names.size());
    for (const mesh::Facet& facet : mesh.facets) {
        auto& nodes = result[static_cast<std::size_t>(facet.boundary)];
        const auto of_facet = space.facet_nodes(facet);
        nodes.insert(nodes.end(), of_facet.begin(), of_facet.end());
    }
    for (auto& nodes : result) {
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    return result;
}

}  // namespace

Space make_space(const mesh::Mesh& mesh, int degree) {
    LagrangeElement element = make_lagrange(mesh.cell, degree);
    Dofmap dofmap = number_nodes(mesh, element);
    auto nodes = node_coordinates(mesh, element, dofmap);
    Space space{std::move(element), std::move(dofmap), std::move(nodes), number_cells(mesh.cell_count()), {}};
    space.boundary_nodes = find_boundary_nodes(mesh, space);
    return space;
}

}  // namespace thermocontact::fem

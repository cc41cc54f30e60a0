#include "parallel/part.h"

#include <metis.h>

#include <algorithm>
#include <numeric>

#include "error.h"

namespace thermocontact::parallel {
namespace {

/// Process of each node: the first of those whose cells have it.
std::vector<std::int32_t> owners_of(const fem::Dofmap& dofmap, const std::vector<std::int32_t>& cell_owners,
                                    int processes) {
    std::vector<std::int32_t> owners(static_cast<std::size_t>(dofmap.node_count), processes);
    for (std::size_t cell = 0; cell < cell_owners.size(); ++cell) {
        for (const std::int32_t node : dofmap.of(static_cast<std::int32_t>(cell))) {
            std::int32_t& owner = owners[static_cast<std::size_t>(node)];
            owner = std::min(owner, cell_owners[cell]);
        }
    }
    return owners;
}

/// Which of the `count` things occur in `used`, in order, and the new number of each (-1: does not occur).
struct Selection {
    std::vector<std::int32_t> kept, index;

    Selection(std::span<const std::int32_t> used, std::size_t count) : index(count, -1) {
        for (const std::int32_t i : used) {
            index[static_cast<std::size_t>(i)] = 0;
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (index[i] == 0) {
                index[i] = static_cast<std::int32_t>(kept.size());
                kept.push_back(static_cast<std::int32_t>(i));
            }
        }
    }
    std::int32_t operator()(std::int32_t i) const { return index[static_cast<std::size_t>(i)]; }
};

template <typename T>
std::vector<T> rows_of(const std::vector<T>& values, std::size_t width,
                       const std::vector<std::int32_t>& rows) {
    std::vector<T> result;
    for (const std::int32_t row : rows) {
        const auto begin =
            values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * width);
        result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
    }
    return result;
}

/// Those of things of which this process has all.
NodeNumbers number_all(std::size_t count) {
    NodeNumbers numbers{std::vector<std::int32_t>(count), {0, static_cast<std::int32_t>(count)}, 0, {}};
    std::iota(numbers.global.begin(), numbers.global.end(), 0);
    numbers.whole = numbers.global;
    return numbers;
}

mesh::Mesh part_of(const mesh::Mesh& whole, const Selection& cells) {
    mesh::Mesh part = whole;
    const auto width = static_cast<std::size_t>(whole.vertices_per_cell);
    part.cells = rows_of(whole.cells, width, cells.kept);
    if (!whole.cell_regions.empty()) {
        part.cell_regions = rows_of(whole.cell_regions, 1, cells.kept);
    }
    const Selection vertices(part.cells, whole.points.size());
    for (std::int32_t& vertex : part.cells) {
        vertex = vertices(vertex);
    }
    part.points = rows_of(whole.points, 1, vertices.kept);
    std::erase_if(part.facets, [&](const mesh::Facet& facet) { return cells(facet.cell) < 0; });
    for (mesh::Facet& facet : part.facets) {
        facet.cell = cells(facet.cell);
    }
    return part;
}

/// Global numbers: process by process, in the order of the whole space.
NodeNumbers number(const std::vector<std::int32_t>& owners, const std::vector<std::int32_t>& kept,
                   int processes, int rank) {
    NodeNumbers numbers;
    numbers.rank = rank;
    numbers.first.assign(static_cast<std::size_t>(processes) + 1, 0);
    for (const std::int32_t owner : owners) {
        ++numbers.first[static_cast<std::size_t>(owner) + 1];
    }
    std::partial_sum(numbers.first.begin(), numbers.first.end(), numbers.first.begin());
    std::vector<std::int32_t> next = numbers.first, global(owners.size());
    for (std::size_t node = 0; node < owners.size(); ++node) {
        global[node] = next[static_cast<std::size_t>(owners[node])]++;
    }
    for (const std::int32_t node : kept) {
        numbers.global.push_back(global[static_cast<std::size_t>(node)]);
    }
    numbers.whole = kept;
    return numbers;
}

}  // namespace

std::vector<std::int32_t> partition(const mesh::Mesh& mesh, int processes) {
    std::vector<idx_t> parts(static_cast<std::size_t>(mesh.cell_count()), 0);
    if (processes > 1 && mesh.cell_count() > processes) {
        idx_t cells = mesh.cell_count(), vertices = static_cast<idx_t>(mesh.points.size()), count = processes,
              cut = 0;
        // cells that share so many vertices share a facet
        idx_t common = mesh.cell == "hexahedron" ? 4 : mesh.dimension;
        std::vector<idx_t> offsets(parts.size() + 1), indices(mesh.cells.begin(), mesh.cells.end());
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            offsets[i] = static_cast<idx_t>(i) * mesh.vertices_per_cell;
        }
        std::vector<idx_t> vertex_parts(mesh.points.size());
        std::array<idx_t, METIS_NOPTIONS> options{};
        METIS_SetDefaultOptions(options.data());
        options[METIS_OPTION_SEED] = 1;
        if (METIS_PartMeshDual(&cells, &vertices, offsets.data(), indices.data(), nullptr, nullptr, &common,
                               &count, nullptr, options.data(), &cut, parts.data(),
                               vertex_parts.data()) != METIS_OK) {
            throw SystemError("METIS could not partition the mesh into " + std::to_string(processes) +
                              " parts");
        }
    } else {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = static_cast<idx_t>(i) % processes;
        }
    }
    return {parts.begin(), parts.end()};
}

Part take_part(mesh::Mesh mesh, fem::Space space, int processes, int rank) {
    const auto all_cells = std::int64_t{mesh.cell_count()};
    const auto all_vertices = static_cast<std::int64_t>(mesh.points.size());
    if (processes == 1) {
        NodeNumbers nodes = number_all(space.nodes.size()), facets = number_all(mesh.facets.size());
        return {std::move(mesh),   std::move(space), std::move(nodes),
                std::move(facets), all_cells,        all_vertices};
    }
    const std::vector<std::int32_t> cell_owners = partition(mesh, processes);
    std::vector<std::int32_t> mine;
    for (std::size_t cell = 0; cell < cell_owners.size(); ++cell) {
        if (cell_owners[cell] == rank) {
            mine.push_back(static_cast<std::int32_t>(cell));
        }
    }
    const Selection cells(mine, cell_owners.size());
    const fem::Dofmap& dofmap = space.dofmap;
    const std::vector<std::int32_t> owners = owners_of(dofmap, cell_owners, processes);
    auto cell_nodes = rows_of(dofmap.cell_nodes, static_cast<std::size_t>(dofmap.nodes_per_cell), cells.kept);
    const Selection nodes(cell_nodes, owners.size());
    for (std::int32_t& node : cell_nodes) {
        node = nodes(node);
    }
    std::vector<std::int32_t> facet_owners, facets;
    for (const mesh::Facet& facet : mesh.facets) {
        facet_owners.push_back(cell_owners[static_cast<std::size_t>(facet.cell)]);
        if (facet_owners.back() == rank) {
            facets.push_back(static_cast<std::int32_t>(facet_owners.size()) - 1);
        }
    }
    Part part{part_of(mesh, cells),
              space,
              number(owners, nodes.kept, processes, rank),
              number(facet_owners, facets, processes, rank),
              all_cells,
              all_vertices};
    part.space.nodes = rows_of(space.nodes, 1, nodes.kept);
    part.space.dofmap.cell_nodes = std::move(cell_nodes);
    part.space.dofmap.node_count = static_cast<std::int32_t>(nodes.kept.size());
    for (auto& on_boundary : part.space.boundary_nodes) {
        std::erase_if(on_boundary, [&](std::int32_t node) { return nodes(node) < 0; });
        std::ranges::transform(on_boundary, on_boundary.begin(), nodes);
    }
    part.space.cellwise.node_count = part.mesh.cell_count();
    part.space.cellwise.cell_nodes.resize(cells.kept.size());
    std::iota(part.space.cellwise.cell_nodes.begin(), part.space.cellwise.cell_nodes.end(), 0);
    return part;
}

}  // namespace thermocontact::parallel

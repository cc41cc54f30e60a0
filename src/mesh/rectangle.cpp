#include "mesh/lattice.h"

namespace thermocontact::mesh {
namespace {

using Cells = std::vector<std::vector<std::int32_t>>;

/// The triangles of a square with corners a b (lower) and c d (upper); `midpoint` serves crossed ones.
Cells triangles(const std::vector<std::int32_t>& corners, std::int32_t midpoint,
                const std::string& diagonal) {
    const auto a = corners[0], b = corners[1], c = corners[2], d = corners[3], m = midpoint;
    if (diagonal == "left") {
        return {{a, b, c}, {b, c, d}};
    }
    if (diagonal == "crossed") {
        return {{a, b, m}, {a, c, m}, {b, d, m}, {c, d, m}};
    }
    return {{a, b, d}, {a, c, d}};
}

}  // namespace

Mesh make_rectangle(const scene::MeshSpec& spec) {
    const Lattice lattice(spec);
    const bool is_cut = spec.cell == "simplex";
    Mesh mesh{2,  is_cut ? "triangle" : "quadrilateral", lattice.points(), is_cut ? 3 : 4, {},
              {}, {"bottom", "left", "right", "top"}};
    for (std::int32_t j = 0; j < lattice.cells(1); ++j) {
        for (std::int32_t i = 0; i < lattice.cells(0); ++i) {
            const auto midpoint = static_cast<std::int32_t>(mesh.points.size());
            if (is_cut && spec.diagonal == "crossed") {
                mesh.points.push_back(lattice.at(i + 0.5, j + 0.5));
            }
            const auto corners = lattice.corners(i, j);
            for (const auto& cell : is_cut ? triangles(corners, midpoint, spec.diagonal) : Cells{corners}) {
                mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
            }
        }
    }
    add_sides(lattice, mesh);
    return mesh;
}

}  // namespace thermocontact::mesh

#include <array>

#include "mesh/lattice.h"

namespace thermocontact::mesh {
namespace {

/// Kuhn's subdivision: the six tetrahedra that follow the edges from corner 0 to corner 7 of a cube, one for
/// each order of the axes. Neighbouring cubes match, and it is the one that dolfinx takes.
constexpr std::array<std::array<std::size_t, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 4, 5, 7}, {0, 2, 3, 7}, {0, 4, 6, 7}, {0, 2, 6, 7}}};

}  // namespace

Mesh make_box(const scene::MeshSpec& spec) {
    const Lattice lattice(spec);
    const bool is_cut = spec.cell == "simplex";
    Mesh mesh{3,
              is_cut ? "tetrahedron" : "hexahedron",
              lattice.points(),
              is_cut ? 4 : 8,
              {},
              {},
              {"back", "bottom", "front", "left", "right", "top"}};
    for (std::int32_t k = 0; k < lattice.cells(2); ++k) {
        for (std::int32_t j = 0; j < lattice.cells(1); ++j) {
            for (std::int32_t i = 0; i < lattice.cells(0); ++i) {
                const auto corners = lattice.corners(i, j, k);
                if (!is_cut) {
                    mesh.cells.insert(mesh.cells.end(), corners.begin(), corners.end());
                    continue;
                }
                for (const auto& tetrahedron : tetrahedra) {
                    for (const std::size_t corner : tetrahedron) {
                        mesh.cells.push_back(corners[corner]);
                    }
                }
            }
        }
    }
    add_sides(lattice, mesh);
    return mesh;
}

}  // namespace thermocontact::mesh

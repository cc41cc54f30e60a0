/// A mesh of simplices as a base mesh and a forest of bisections: each cell of the base is the root of a tree
/// of halves, whose leaves are the cells of the mesh.
///
/// Triangles are bisected from their newest vertex, tetrahedra as D. N. Arnold, A. Mukherjee and L. Pouly,
/// Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000) 431-448, do: each cell
/// carries a refinement edge, and each face of a tetrahedron a marked one. In the base they are the longest,
/// by (length to nine digits, numbers of the ends), an order that all cells share. From any such base, the
/// closure (bisect what has a hanging node until nothing has) ends, and the shapes of all cells fall into
/// finitely many classes, however deep the trees: at most 4 below a triangle, 72 below a tetrahedron.
///
/// How a cell is bisected depends on itself alone, so that the mesh, its numbers included, is a function of
/// the base and of which cells are bisected, not of the way there.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mesh/mesh.h"

namespace thermocontact::mesh {

/// Which cells are bisected: of each cell of the base, in order, its tree in preorder; 1: bisected, 0: a
/// cell of the mesh.
using Bisections = std::vector<std::int64_t>;

class Forest {
  public:
    struct Cell {
        /// The first two are the ends of the refinement edge.
        std::array<std::int32_t, 4> vertices{-1, -1, -1, -1};
        /// [vertex]: the boundary that the facet opposite to it lies on, or -1.
        std::array<std::int32_t, 4> boundaries{-1, -1, -1, -1};
        /// Of a tetrahedron's faces opposite to the first and the second vertex: the vertex, by its place in
        /// `vertices`, that the marked edge leaves out.
        std::array<std::int8_t, 2> left_out{3, 3};
        bool flag = false;        ///< of planar tetrahedra
        std::int32_t child = -1;  ///< its halves are this one, which has the first vertex, and the next
        std::int32_t root = -1;   ///< cell of the base
        std::int32_t level = 0;   ///< bisections since
        std::int32_t leaf = -1;   ///< cell of the mesh
    };

    /// The base itself.
    explicit Forest(std::shared_ptr<const Mesh> base);

    /// Throws SceneError where the numbers describe no conforming mesh of this base.
    Forest(std::shared_ptr<const Mesh> base, const Bisections& bisections);

    /// The smallest conforming forest of the same base all of whose cells within cell i of this one's mesh
    /// have been bisected `levels`[i] times or more.
    Forest with_levels(const std::vector<int>& levels) const;

    /// Regions and boundaries are those of the base. Vertices of the base keep their numbers, cells come in
    /// the order of the trees; without bisections it is the base.
    Mesh mesh() const;

    Bisections bisections() const;

    std::int32_t cell_count() const { return leaf_count_; }
    int deepest() const;  ///< level

    /// Trees: the cells of the base come first.
    const std::vector<Cell>& cells() const { return cells_; }
    std::int32_t root_count() const { return base_->cell_count(); }
    int vertices_per_cell() const { return base_->vertices_per_cell; }
    const Cell& at(std::int32_t cell) const { return cells_[static_cast<std::size_t>(cell)]; }

    /// [cells of the mesh]: the number of each in cells().
    std::vector<std::int32_t> leaves() const;

  private:
    void plant();
    std::int32_t middle(std::int32_t a, std::int32_t b);
    bool has_hanging_node(const Cell& cell) const;
    void bisect(std::int32_t cell);
    void number_leaves();

    std::shared_ptr<const Mesh> base_;
    std::vector<Point> points_;
    std::vector<Cell> cells_;
    std::unordered_map<std::uint64_t, std::int32_t> middles_;  ///< of edges that have been bisected
    std::int32_t leaf_count_ = 0;
};

}  // namespace thermocontact::mesh

#include "parallel/part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/scenes.h"

namespace thermocontact::parallel {
namespace {

struct Case {
    std::string name, text;
    int processes;
};

/// All parts of a mesh, whose cells lie in two regions and in none.
class Parts : public testing::TestWithParam<Case> {
  protected:
    mesh::Mesh whole = mesh::make_mesh(
        scene::read(GetParam().text + "time = {end = 1, steps = 1}\nheat.capacity = 1\n").mesh);
    std::vector<fem::Space> spaces;
    std::vector<std::vector<Part>> parts;  ///< [degrees][processes]

    Parts() {
        whole.region_names = {"a", "b"};
        for (std::int32_t cell = 0; cell < whole.cell_count(); ++cell) {
            whole.cell_regions.push_back(cell % 3 - 1);
        }
        for (const int degree : {1, 2}) {
            spaces.push_back(fem::make_space(whole, degree));
            parts.emplace_back();
            for (int rank = 0; rank < GetParam().processes; ++rank) {
                parts.back().push_back(take_part(whole, spaces.back(), GetParam().processes, rank));
            }
        }
    }
};

/// A cell, by the places of its vertices.
using Places = std::vector<mesh::Point>;

Places places(const mesh::Mesh& mesh, std::int32_t cell) {
    Places result;
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
        result.push_back(mesh.points[static_cast<std::size_t>(vertex)]);
    }
    return result;
}

TEST_P(Parts, EveryCellIsInOneWithItsRegion) {
    std::set<std::pair<Places, std::int32_t>> expected, found;
    for (std::int32_t cell = 0; cell < whole.cell_count(); ++cell) {
        expected.emplace(places(whole, cell), whole.cell_regions[static_cast<std::size_t>(cell)]);
    }
    std::int32_t count = 0;
    for (const Part& part : parts[0]) {
        EXPECT_EQ(part.cells, whole.cell_count());
        EXPECT_EQ(part.vertices, static_cast<std::int64_t>(whole.points.size()));
        EXPECT_GT(part.mesh.cell_count(), 0);
        ASSERT_EQ(part.mesh.cell_regions.size(), static_cast<std::size_t>(part.mesh.cell_count()));
        count += part.mesh.cell_count();
        for (std::int32_t cell = 0; cell < part.mesh.cell_count(); ++cell) {
            found.emplace(places(part.mesh, cell), part.mesh.cell_regions[static_cast<std::size_t>(cell)]);
        }
    }
    EXPECT_EQ(count, whole.cell_count());
    EXPECT_EQ(found, expected);
}

TEST_P(Parts, EveryFacetIsInOneAtItsCell) {
    using Named = std::pair<Places, std::pair<std::int32_t, std::int32_t>>;
    const auto all = [](const mesh::Mesh& mesh, std::multiset<Named>& facets) {
        for (const mesh::Facet& facet : mesh.facets) {
            facets.emplace(places(mesh, facet.cell), std::pair(facet.local, facet.boundary));
        }
    };
    std::multiset<Named> expected, found;
    all(whole, expected);
    for (const Part& part : parts[0]) {
        EXPECT_EQ(part.mesh.boundary_names, whole.boundary_names);
        EXPECT_TRUE(std::ranges::is_sorted(part.mesh.facets, {}, &mesh::Facet::boundary));
        all(part.mesh, found);
    }
    EXPECT_EQ(found, expected);
}

TEST_P(Parts, NodesKeepTheirPlacesAndCells) {
    for (std::size_t degree = 0; degree < parts.size(); ++degree) {
        for (const Part& part : parts[degree]) {
            ASSERT_EQ(part.space.nodes.size(), part.numbers.whole.size());
            EXPECT_EQ(part.space.dofmap.node_count, static_cast<std::int32_t>(part.space.nodes.size()));
            EXPECT_EQ(part.space.cellwise.node_count, part.mesh.cell_count());
            for (std::size_t node = 0; node < part.space.nodes.size(); ++node) {
                const auto in_whole = static_cast<std::size_t>(part.numbers.whole[node]);
                EXPECT_EQ(part.space.nodes[node], spaces[degree].nodes[in_whole]);
            }
            // the same element on the same vertices has its nodes at the same places
            const fem::Space own = fem::make_space(part.mesh, static_cast<int>(degree) + 1);
            for (std::int32_t cell = 0; cell < part.mesh.cell_count(); ++cell) {
                for (std::size_t i = 0; i < own.dofmap.of(cell).size(); ++i) {
                    const auto here = static_cast<std::size_t>(part.space.dofmap.of(cell)[i]);
                    const auto there = static_cast<std::size_t>(own.dofmap.of(cell)[i]);
                    EXPECT_EQ(part.space.nodes[here], own.nodes[there]);
                }
            }
        }
    }
}

/// One number for each node, whichever process asks; those that a process owns are consecutive, and it has
/// them.
TEST_P(Parts, GlobalNumbersAreAPermutation) {
    for (std::size_t degree = 0; degree < parts.size(); ++degree) {
        const auto nodes = static_cast<std::int32_t>(spaces[degree].nodes.size());
        std::vector<std::int32_t> number(static_cast<std::size_t>(nodes), -1);
        for (const Part& part : parts[degree]) {
            EXPECT_EQ(part.numbers.total(), nodes);
            EXPECT_EQ(part.numbers.first, parts[degree].front().numbers.first);
            std::int32_t owned = 0;
            for (std::size_t i = 0; i < part.numbers.whole.size(); ++i) {
                const std::int32_t global = part.numbers.global[i];
                std::int32_t& known = number[static_cast<std::size_t>(part.numbers.whole[i])];
                EXPECT_TRUE(known == -1 || known == global);
                known = global;
                owned += global >= part.numbers.begin() && global < part.numbers.end() ? 1 : 0;
            }
            EXPECT_EQ(owned, part.numbers.end() - part.numbers.begin());
        }
        std::ranges::sort(number);
        for (std::int32_t i = 0; i < nodes; ++i) {
            EXPECT_EQ(number[static_cast<std::size_t>(i)], i);
        }
    }
}

const std::string rectangle = "mesh = {cells = [5, 4], upper = [2, 1], diagonal = \"crossed\"}\n";
const std::string box = "mesh = {shape = \"box\", cells = [3, 2, 2], upper = [3, 2, 1]";

/// Also where the facet is another part's: prescribed values concern every process that has the node.
TEST_P(Parts, ANodeOfABoundaryIsOnItInEveryPart) {
    for (std::size_t degree = 0; degree < spaces.size(); ++degree) {
        for (const Part& part : parts[degree]) {
            for (std::size_t boundary = 0; boundary < whole.boundary_names.size(); ++boundary) {
                const auto& of_whole = spaces[degree].boundary_nodes[boundary];
                std::vector<std::int32_t> expected;
                for (std::size_t node = 0; node < part.numbers.whole.size(); ++node) {
                    if (std::ranges::binary_search(of_whole, part.numbers.whole[node])) {
                        expected.push_back(static_cast<std::int32_t>(node));
                    }
                }
                EXPECT_EQ(part.space.boundary_nodes[boundary], expected);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Parts,
                         testing::Values(Case{"alone", rectangle, 1}, Case{"two", rectangle, 2},
                                         Case{"seven", rectangle, 7}, Case{"tetrahedra", box + "}\n", 3},
                                         Case{"hexahedra", box + ", cell = \"tensor\"}\n", 3},
                                         Case{"a_cell_each", box + ", cell = \"tensor\"}\n", 12}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::parallel

// Gmsh's files: what a good one becomes, and what is said of bad ones.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "error.h"
#include "mesh/gmsh_file.h"

namespace thermocontact::mesh {
namespace {

/// The unit square in two triangles, as version 2.2 writes it; each part can be replaced.
struct Square {
    std::string names = "$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"body\"\n$EndPhysicalNames\n";
    std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
    std::string elements =
        "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 2 3 3 4\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    std::string text() const { return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + nodes + elements; }
};

/// Reads a file with that text.
Mesh read(const std::string& text) {
    const auto path =
        std::filesystem::path(testing::TempDir()) / ("thermocontact-" + std::to_string(getpid()) + ".msh");
    std::ofstream(path, std::ios::binary) << text;
    struct Remove {
        const std::filesystem::path& path;
        ~Remove() { std::filesystem::remove(path); }
    } const remove{path};
    return read_gmsh(path);
}

/// The message without the folder; "" if the file is taken.
std::string message(const std::string& text) {
    try {
        read(text);
        return {};
    } catch (const SceneError& error) {
        const std::string what = error.what();
        return what.substr(what.find(".msh") + 4);
    }
}

void expect_message(const std::string& text, const std::string& part) {
    EXPECT_NE(message(text).find(part), std::string::npos) << message(text);
}

TEST(Gmsh, SquareOfTriangles) {
    const Mesh mesh = read(Square().text());
    EXPECT_EQ(mesh.dimension, 2);
    EXPECT_EQ(mesh.cell, "triangle");
    EXPECT_EQ(mesh.points.size(), 4U);
    EXPECT_EQ(mesh.cells, (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"bottom", "top"}));
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
    EXPECT_EQ(mesh.cell_regions, (std::vector<std::int32_t>{0, 0}));
    ASSERT_EQ(mesh.facets.size(), 2U);  // the other two sides have no name and are free
    EXPECT_EQ(mesh.facets[0].cell, 0);
    EXPECT_EQ(mesh.facets[0].local, 2);  // between vertices 0 and 1
    EXPECT_EQ(mesh.facets[1].cell, 1);
    EXPECT_EQ(mesh.facets[1].local, 0);
}

TEST(Gmsh, QuadrilateralsTakeTheOrderOfBasix) {
    Square square;
    square.elements = "$Elements\n2\n1 1 2 1 1 1 2\n3 3 2 3 1 1 2 3 4\n$EndElements\n";
    const Mesh mesh = read(square.text());
    EXPECT_EQ(mesh.cell, "quadrilateral");
    EXPECT_EQ(mesh.cells, (std::vector<std::int32_t>{0, 1, 3, 2}));
}

TEST(Gmsh, HexahedraTakeTheOrderOfBasix) {
    Square cube;
    cube.names = "$PhysicalNames\n1\n3 3 \"body\"\n$EndPhysicalNames\n";
    cube.nodes =
        "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n";
    cube.elements = "$Elements\n1\n1 5 2 3 1 1 2 3 4 5 6 7 8\n$EndElements\n";
    const Mesh mesh = read(cube.text());
    EXPECT_EQ(mesh.cell, "hexahedron");
    EXPECT_EQ(mesh.cells, (std::vector<std::int32_t>{0, 1, 3, 2, 4, 5, 7, 6}));
}

/// Cells that no group names belong to no region, beside others that do.
TEST(Gmsh, CellsOfNoGroup) {
    Square square;
    square.elements = "$Elements\n2\n3 2 2 3 1 1 2 3\n4 2 2 0 2 1 3 4\n$EndElements\n";
    const Mesh mesh = read(square.text());
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"body"});
    EXPECT_EQ(mesh.cell_regions, (std::vector<std::int32_t>{0, -1}));
}

TEST(Gmsh, TheOrderOfASimplexDoesNotMatter) {
    Square square;
    square.elements = "$Elements\n2\n3 2 2 3 1 2 1 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    EXPECT_EQ(message(square.text()), "");
}

TEST(Gmsh, MissingFileAndFolder) {
    for (const auto& [path, words] : {std::pair("/no/such.msh", "/no/such.msh: no such file"),
                                      std::pair("/tmp", "/tmp: cannot be read")}) {
        try {
            read_gmsh(path);
            FAIL();
        } catch (const SceneError& error) {
            EXPECT_STREQ(error.what(), words);
        }
    }
}

TEST(Gmsh, NotAMesh) {
    expect_message("Point(1) = {0, 0, 0};\n", ":1: expected a Gmsh mesh, which begins with $MeshFormat");
    expect_message("", ":1: expected a Gmsh mesh");
    expect_message("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ": has no section $Nodes");
}

/// Cut off anywhere, the file is refused in good order.
TEST(Gmsh, Truncated) {
    const std::string text = Square().text();
    for (std::size_t length = 0; length + 12 < text.size(); ++length) {
        EXPECT_NE(message(text.substr(0, length)), "") << length;
    }
    expect_message(text.substr(0, text.find("$EndNodes") - 4),
                   ":10: the section $Nodes that begins here has no $EndNodes; the file is truncated");
}

TEST(Gmsh, CountsThatDoNotFit) {
    Square square;
    square.nodes.replace(square.nodes.find("4\n1 0"), 1, "9");
    EXPECT_NE(message(square.text()), "");
}

TEST(Gmsh, UnnamedGroup) {
    Square square;
    square.names = "$PhysicalNames\n2\n1 1 \"bottom\"\n2 3 \"body\"\n$EndPhysicalNames\n";
    expect_message(square.text(), ": physical group 2 of dimension 1 has no name; expected one");
}

TEST(Gmsh, DuplicateNodes) {
    Square square;
    square.nodes = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 1 1 0\n$EndNodes\n";
    square.elements = "$Elements\n2\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 5 4\n$EndElements\n";
    expect_message(square.text(),
                   ": nodes 3 and 5 lie at the same place (1, 1, 0); expected one node a place");
    // nearer than the tolerance, on two sides of x = 0, a border of the grid that they are sought in
    square.nodes = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 -1e-11 0 0\n$EndNodes\n";
    square.elements = "$Elements\n2\n3 2 2 3 1 1 2 3\n4 2 2 3 1 5 3 4\n$EndElements\n";
    expect_message(square.text(), ": nodes 1 and 5 lie at the same place");
}

TEST(Gmsh, InvertedCells) {
    Square square;
    square.nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0.9 0.1 0\n$EndNodes\n";
    expect_message(square.text(), ": elements 3 and 4 overlap");
    square = {};
    square.elements = "$Elements\n1\n3 3 2 3 1 1 4 3 2\n$EndElements\n";
    EXPECT_EQ(message(square.text()), "");  // clockwise, but convex
    square.elements = "$Elements\n1\n3 3 2 3 1 1 3 2 4\n$EndElements\n";
    expect_message(square.text(), ": quadrilateral 3 is inverted");
    square.nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0.5 0.5 0\n$EndNodes\n";
    square.elements = "$Elements\n1\n4 2 2 3 1 1 3 4\n$EndElements\n";
    expect_message(square.text(), ": triangle 4 is flat");
}

TEST(Gmsh, WrongDimension) {
    Square square;
    square.elements = "$Elements\n2\n1 1 2 1 1 1 2\n2 1 2 2 3 3 4\n$EndElements\n";
    expect_message(square.text(), ": has no cells of dimension 2 or 3");
    square = {};
    square.nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0.5\n4 0 1 0\n$EndNodes\n";
    expect_message(square.text(), ": node 3 lies at z = 0.5; expected z = 0");
    square.nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 -0.5\n4 0 1 0\n$EndNodes\n";
    expect_message(square.text(), ": node 3 lies at z = -0.5; expected z = 0");
}

TEST(Gmsh, MixedOrCurvedCells) {
    Square square;
    square.nodes = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0.5 0\n$EndNodes\n";
    square.elements = "$Elements\n2\n3 3 2 3 1 1 2 3 4\n4 2 2 3 1 2 5 3\n$EndElements\n";
    expect_message(square.text(), "among cells that are of kind");
    square.nodes = "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 0 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n";
    square.elements = "$Elements\n1\n3 9 2 3 1 1 2 3 4 5 6\n$EndElements\n";
    expect_message(square.text(), "element 3 is of Gmsh's type \"Triangle 6\"; expected");
}

TEST(Gmsh, BoundaryInsideTheBodyOrBesideIt) {
    Square square;
    square.elements = "$Elements\n3\n1 1 2 1 1 1 3\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    expect_message(square.text(), ": element 1 of the boundary \"bottom\" lies inside the body");
    square.elements = "$Elements\n3\n1 1 2 1 1 2 4\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    expect_message(square.text(), ": element 1 of the boundary \"bottom\" is no facet of a cell");
}

/// A facet that two groups claim, as one entity with both or as two elements.
TEST(Gmsh, FacetInTwoGroups) {
    Square square;
    square.elements =
        "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 2 1 1 2\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    expect_message(square.text(),
                   R"(: the boundaries "bottom" and "top" share the entity 1; expected each entity in one)");
    square.elements =
        "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 2 3 2 1\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    expect_message(
        square.text(),
        R"(: element 2 of the boundary "top" belongs to the boundary "bottom" as well; expected each)");
    square.elements =  // twice in one group: once
        "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 1 3 2 1\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n$EndElements\n";
    EXPECT_EQ(read(square.text()).facets.size(), 1U);
}

TEST(Gmsh, CellInTwoRegions) {
    Square square;
    square.names = "$PhysicalNames\n2\n2 3 \"body\"\n2 4 \"core\"\n$EndPhysicalNames\n";
    square.elements = "$Elements\n3\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n5 2 2 4 2 1 3 4\n$EndElements\n";
    expect_message(square.text(), ": elements ");
    square.elements = "$Elements\n3\n3 2 2 3 1 1 2 3\n4 2 2 3 1 1 3 4\n5 2 2 4 1 1 3 4\n$EndElements\n";
    expect_message(square.text(), R"(: the regions "body" and "core" share the entity 1)");
}

/// Gmsh writes the points of the geometry as well, like the centre of an arc: no cell has them, nor does the
/// mesh.
TEST(Gmsh, NodesOfNoCellAreLeftOut) {
    Square square;
    square.nodes = "$Nodes\n6\n9 7 7 7\n1 0 0 0\n2 1 0 0\n3 1 1 0\n8 0 0 0\n4 0 1 0\n$EndNodes\n";
    const Mesh mesh = read(square.text());
    EXPECT_EQ(mesh.points.size(), 4U);
    EXPECT_EQ(mesh.cells, (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Gmsh, NodeThatIsNotThere) {
    Square square;
    square.elements = "$Elements\n1\n3 2 2 3 1 1 2 7\n$EndElements\n";
    EXPECT_NE(message(square.text()), "");
}

}  // namespace
}  // namespace thermocontact::mesh

#include "mesh/gmsh_file.h"

#include <algorithm>
#include <map>
#include <set>

#include "error.h"
#include "mesh/cell_shape.h"
#include "mesh/geometry_check.h"
#include "mesh/gmsh_library.h"
#include "mesh/gmsh_sections.h"
#include "number.h"

namespace thermocontact::mesh {
namespace {

/// A kind of elements as Gmsh numbers it, and the place of each Basix vertex among Gmsh's.
struct ElementType {
    std::string cell;
    std::vector<std::size_t> vertices;
};

const std::map<int, ElementType>& cell_types() {
    static const std::map<int, ElementType> types = {{2, {"triangle", {0, 1, 2}}},
                                                     {3, {"quadrilateral", {0, 1, 3, 2}}},
                                                     {4, {"tetrahedron", {0, 1, 2, 3}}},
                                                     {5, {"hexahedron", {0, 1, 3, 2, 4, 5, 7, 6}}}};
    return types;
}

std::string in_quotes(const std::string& name) {
    return '"' + name + '"';
}

/// Turns what Gmsh read into a mesh, faults into SceneErrors.
class Reader {
  public:
    Reader(std::filesystem::path path, GmshContents contents)
        : path_(std::move(path)), contents_(std::move(contents)) {}

    Mesh read();

  private:
    using Elements = std::vector<const GmshElements*>;

    [[noreturn]] void fail(const std::string& message) const {
        throw SceneError(path_.string() + ": " + message);
    }

    Elements elements_of(int dimension) const;
    void check_names() const;
    void choose_cells();
    std::map<int, std::int32_t> number_groups(int dimension, std::vector<std::string>& names) const;
    void read_cells();
    void read_points();
    void check_plane() const;
    void read_facets(const FacetMap& facets);

    std::filesystem::path path_;
    GmshContents contents_;
    Elements cells_;
    Mesh mesh_;
    Tags tags_;
    std::map<std::size_t, std::int32_t> vertices_;  ///< by their tags, of the nodes that cells use
};

Reader::Elements Reader::elements_of(int dimension) const {
    Elements result;
    for (const GmshElements& elements : contents_.elements) {
        if (elements.dimension == dimension && !elements.tags.empty()) {
            result.push_back(&elements);
        }
    }
    return result;
}

/// Every group that the mesh will use has a name.
void Reader::check_names() const {
    static const char* const words[] = {"Point", "Curve", "Surface", "Volume"};
    for (const GmshGroup& group : contents_.groups) {
        if (group.name.empty() && group.dimension >= mesh_.dimension - 1) {
            const std::string word = words[group.dimension];
            fail("physical group " + std::to_string(group.tag) + " of dimension " +
                 std::to_string(group.dimension) + " has no name; expected one, as in Physical " + word +
                 "(\"NAME\") = {...}");
        }
    }
}

/// The elements of the highest dimension, all of one kind.
void Reader::choose_cells() {
    mesh_.dimension = elements_of(3).empty() ? 2 : 3;
    cells_ = elements_of(mesh_.dimension);
    if (cells_.empty()) {
        fail("has no cells of dimension 2 or 3; expected triangles, quadrilaterals, tetrahedra or hexahedra");
    }
    for (const GmshElements* elements : cells_) {
        const auto type = cell_types().find(elements->type);
        const std::string element = "element " + std::to_string(elements->tags.front());
        if (type == cell_types().end()) {
            fail(element + " is of Gmsh's type \"" + elements->type_name +
                 "\"; expected triangles, quadrilaterals, tetrahedra or hexahedra of first order "
                 "(Mesh.ElementOrder = 1; space.degree sets the degree of the unknowns)");
        }
        if (!mesh_.cell.empty() && mesh_.cell != type->second.cell) {
            fail(element + " is a " + type->second.cell + " among cells that are of kind " + mesh_.cell +
                 "; expected cells of one kind");
        }
        mesh_.cell = type->second.cell;
    }
    mesh_.vertices_per_cell = cell_shape(mesh_.cell).vertices;
}

/// The group of each entity of that dimension, as an index into `names`; groups of one name are one.
std::map<int, std::int32_t> Reader::number_groups(int dimension, std::vector<std::string>& names) const {
    std::set<std::string> sorted;
    for (const GmshGroup& group : contents_.groups) {
        if (group.dimension == dimension) {
            sorted.insert(group.name);
        }
    }
    names.assign(sorted.begin(), sorted.end());
    std::map<int, std::int32_t> group_of;
    for (const GmshGroup& group : contents_.groups) {
        const auto index = static_cast<std::int32_t>(std::ranges::find(names, group.name) - names.begin());
        for (std::size_t i = 0; group.dimension == dimension && i < group.entities.size(); ++i) {
            const auto [known, is_new] = group_of.emplace(group.entities[i], index);
            if (!is_new && known->second != index) {
                fail((dimension == mesh_.dimension ? "the regions " : "the boundaries ") +
                     in_quotes(names[static_cast<std::size_t>(known->second)]) + " and " +
                     in_quotes(group.name) + " share the entity " + std::to_string(group.entities[i]) +
                     "; expected each entity in one physical group");
            }
        }
    }
    return group_of;
}

/// Cells by tags of their nodes, then by vertices.
void Reader::read_cells() {
    const auto region_of = number_groups(mesh_.dimension, mesh_.region_names);
    const auto n = static_cast<std::size_t>(mesh_.vertices_per_cell);
    std::vector<std::size_t> nodes;
    for (const GmshElements* elements : cells_) {
        const auto region = region_of.find(elements->entity);
        for (std::size_t i = 0; i < elements->tags.size(); ++i) {
            tags_.cells.push_back(elements->tags[i]);
            mesh_.cell_regions.push_back(region == region_of.end() ? -1 : region->second);
            for (const std::size_t v : cell_types().at(elements->type).vertices) {
                nodes.push_back(elements->nodes[i * n + v]);
            }
        }
    }
    for (const std::size_t node : nodes) {
        vertices_.emplace(node, -1);
    }
    read_points();
    for (const std::size_t node : nodes) {
        mesh_.cells.push_back(vertices_.at(node));
    }
    if (mesh_.region_names.empty()) {
        mesh_.cell_regions.clear();
    }
}

void Reader::read_points() {
    for (std::size_t i = 0; i < contents_.node_tags.size(); ++i) {
        const auto vertex = vertices_.find(contents_.node_tags[i]);
        if (vertex == vertices_.end()) {
            continue;  // a node of no cell: of the geometry
        }
        if (vertex->second >= 0) {
            fail("node " + std::to_string(vertex->first) + " is there twice; expected each number once");
        }
        vertex->second = static_cast<std::int32_t>(mesh_.points.size());
        mesh_.points.push_back(contents_.points[i]);
        tags_.nodes.push_back(vertex->first);
    }
    for (const auto& [tag, vertex] : vertices_) {
        if (vertex < 0) {
            fail("node " + std::to_string(tag) + " of a cell is not among the nodes");
        }
    }
}

/// A body in two dimensions lies in the plane z = 0.
void Reader::check_plane() const {
    for (std::size_t v = 0; mesh_.dimension == 2 && v < mesh_.points.size(); ++v) {
        if (mesh_.points[v][2] != 0.0) {
            fail("node " + std::to_string(tags_.nodes[v]) + " lies at z = " + short_text(mesh_.points[v][2]) +
                 "; expected z = 0 everywhere in a mesh of " + mesh_.cell +
                 "s, or cells of dimension 3 (a physical group of volumes)");
        }
    }
}

void Reader::read_facets(const FacetMap& facets) {
    const auto boundary_of = number_groups(mesh_.dimension - 1, mesh_.boundary_names);
    std::vector<std::int32_t> vertices;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> taken;  // boundary by cell and local number
    for (const GmshElements* elements : elements_of(mesh_.dimension - 1)) {
        const auto boundary = boundary_of.find(elements->entity);
        if (boundary == boundary_of.end()) {
            continue;
        }
        const std::string& name = mesh_.boundary_names[static_cast<std::size_t>(boundary->second)];
        const std::size_t n = elements->nodes.size() / elements->tags.size();
        for (std::size_t i = 0; i < elements->tags.size(); ++i) {
            vertices.clear();
            for (std::size_t v = 0; v < n; ++v) {
                const auto vertex = vertices_.find(elements->nodes[i * n + v]);
                vertices.push_back(vertex == vertices_.end() ? -1 : vertex->second);
            }
            const auto found = n > 4 ? facets.end() : facets.find(facet_key(vertices));
            const std::string element =
                "element " + std::to_string(elements->tags[i]) + " of the boundary " + in_quotes(name);
            if (found == facets.end()) {
                fail(element + " is no facet of a cell; expected facets of the cells there are");
            }
            if (found->second.size() > 1) {
                fail(element + " lies inside the body, between two cells; expected facets on its surface");
            }
            const CellFacet& at = found->second.front();
            const auto [other, is_new] = taken.emplace(std::pair(at.cell, at.local), boundary->second);
            if (other->second != boundary->second) {
                fail(element + " belongs to the boundary " +
                     in_quotes(mesh_.boundary_names[static_cast<std::size_t>(other->second)]) +
                     " as well; expected each facet in one physical group");
            }
            if (is_new) {
                mesh_.facets.push_back({at.cell, at.local, boundary->second});
            }
        }
    }
    std::ranges::sort(mesh_.facets, {},
                      [](const Facet& f) { return std::tuple(f.boundary, f.cell, f.local); });
}

Mesh Reader::read() {
    choose_cells();
    check_names();
    read_cells();
    check_plane();
    const FacetMap facets = map_facets(mesh_);
    if (const auto fault = geometric_fault(mesh_, facets, tags_)) {
        fail(*fault);
    }
    read_facets(facets);
    return std::move(mesh_);
}

/// Gmsh's words about a file, at the section that they speak of.
[[noreturn]] void fail_reading(const std::filesystem::path& path, const std::vector<GmshSection>& sections,
                               const std::string& words) {
    std::string where = path.string();
    for (const auto& [word, section] : {std::pair("node", "Nodes"), std::pair("element", "Elements")}) {
        const auto at = std::ranges::find(sections, section, &GmshSection::name);
        if (words.find(word) != std::string::npos && at != sections.end()) {
            where += ":" + std::to_string(at->line);
            break;
        }
    }
    throw SceneError(where + ": Gmsh cannot read the file: " + (words.empty() ? "no reason given" : words));
}

}  // namespace

Mesh read_gmsh(const std::filesystem::path& path) {
    const auto sections = check_sections(path);
    GmshContents contents;
    try {
        contents = read_with_gmsh(path);
    } catch (const SystemError&) {
        throw;
    } catch (const std::runtime_error& error) {
        fail_reading(path, sections, error.what());
    }
    return Reader(path, std::move(contents)).read();
}

}  // namespace thermocontact::mesh

/// Gmsh's own reader of mesh files. The library is loaded only when a scene names a file: a process that
/// links it takes 0.15 s to start.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace thermocontact::mesh {

/// A physical group, and the elementary entities in it.
struct GmshGroup {
    int dimension, tag;
    std::string name;  ///< "": the file has none
    std::vector<int> entities;
};

/// The elements of one type on one entity.
struct GmshElements {
    int dimension, entity;
    int type;               ///< Gmsh's number
    std::string type_name;  ///< "Triangle 3"
    std::vector<std::size_t> tags;
    std::vector<std::size_t> nodes;  ///< [elements][nodes of an element]: tags of nodes
};

struct GmshContents {
    std::vector<std::size_t> node_tags;
    std::vector<Point> points;  ///< of these nodes, m
    std::vector<GmshGroup> groups;
    std::vector<GmshElements> elements;
};

/// Read by a process of its own. Throws SystemError without the library, std::runtime_error with Gmsh's words
/// where it cannot read the file, or how it ended.
GmshContents read_with_gmsh(const std::filesystem::path& path);

}  // namespace thermocontact::mesh

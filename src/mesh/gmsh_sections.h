/// The sections of a Gmsh file, for messages that say where it is broken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace thermocontact::mesh {

struct GmshSection {
    std::string name;  ///< "Nodes" of $Nodes ... $EndNodes
    int line;          ///< of $Nodes
};

/// Throws SceneError "PATH: ..." unless the file can be read, begins like a Gmsh mesh and has an end to every
/// section, with nodes and elements among them.
std::vector<GmshSection> check_sections(const std::filesystem::path& path);

}  // namespace thermocontact::mesh

// What [mesh] says of the body: its dimension, and the names of its boundaries and regions.

#include <algorithm>
#include <map>

#include "error.h"
#include "mesh/gmsh_file.h"
#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

const std::map<std::string, Body>& shapes() {
    static const std::map<std::string, Body> bodies = {
        {"rectangle", {2, "rectangle", {"left", "right", "bottom", "top"}, {}}},
        {"box", {3, "box", {"left", "right", "bottom", "top", "front", "back"}, {}}}};
    return bodies;
}

/// The mesh of mesh.file, which is sought from the scene's folder.
Body body_of_file(const Document& document, const Entry& entry) {
    const auto name = check_value(*schema().find(entry.key), entry, 2).get<std::string>();
    const auto path = std::filesystem::path(document.file).parent_path() / name;
    try {
        auto mesh = std::make_shared<const mesh::Mesh>(mesh::read_gmsh(path));
        return {mesh->dimension, "mesh " + name, mesh->boundary_names, mesh->region_names, mesh};
    } catch (const SceneError& error) {
        fail(entry.where, entry.key + ": " + error.what());
    }
}

}  // namespace

bool is_plane_strain(const Settings& settings) {
    const auto says_so = [&](const std::string& key) {
        return settings.has(key) && settings.value(key) == "strain";
    };
    return says_so("material.elasticity.plane") ||
           std::ranges::any_of(settings.regions, [&](const std::string& region) {
               return says_so("region." + region + ".material.elasticity.plane");
           });
}

Body body_of(const Document& document) {
    if (const Entry* file = document.find("mesh.file")) {
        return body_of_file(document, *file);
    }
    const Entry* shape = document.find("mesh.shape");
    return shapes().at(shape == nullptr
                           ? "rectangle"
                           : check_value(*schema().find("mesh.shape"), *shape, 2).get<std::string>());
}

}  // namespace thermocontact::scene

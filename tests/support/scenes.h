/// Scenes for the tests of the numerics: those of the repository, and small ones written in place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fem/block_matrix.h"
#include "mesh/shapes.h"
#include "model/contact_surface.h"
#include "scene/scene_files.h"

namespace thermocontact::support {

using Overrides = std::vector<std::string>;

/// A file of the folder scenes/.
inline scene::Scene repository_scene(const std::string& name, const Overrides& overrides = {}) {
    return scene::read_scene(std::filesystem::path(THERMOCONTACT_SCENES) / (name + ".toml"), overrides);
}

/// A scene with what discretises it.
struct Discretisation {
    scene::Scene scene;
    mesh::Mesh mesh;
    fem::Space space;
    fem::NodeGraph graph;
    model::ContactSurfaces surfaces;

    explicit Discretisation(scene::Scene given)
        : scene(std::move(given)),
          mesh(mesh::make_mesh(scene.mesh)),
          space(fem::make_space(mesh, scene.degree)),
          graph(fem::make_node_graph(space)),
          surfaces(model::make_contact_surfaces(scene, mesh, space)) {}

    explicit Discretisation(const std::string& text, const Overrides& overrides = {})
        : Discretisation(scene::read(text, overrides)) {}

    std::size_t node_count() const { return space.nodes.size(); }

    /// [nodes][values]: `field`(x, y) at every node.
    template <typename Field>
    std::vector<double> nodal(Field field) const {
        std::vector<double> result;
        for (const mesh::Point& x : space.nodes) {
            for (const double value : field(x[0], x[1])) {
                result.push_back(value);
            }
        }
        return result;
    }
};

}  // namespace thermocontact::support

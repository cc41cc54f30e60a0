#include "model/pieces.h"

namespace thermocontact::model {

std::map<std::string, std::vector<std::int32_t>> cells_by_laws(const scene::Scene& scene,
                                                               const mesh::Mesh& mesh) {
    std::map<std::string, std::vector<std::int32_t>> cells;
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::int32_t region =
            scene.regions.empty() ? -1 : mesh.cell_regions[static_cast<std::size_t>(cell)];
        const std::string name = region < 0 ? "" : mesh.region_names[static_cast<std::size_t>(region)];
        cells[scene.regions.contains(name) ? name : ""].push_back(cell);
    }
    return cells;
}

}  // namespace thermocontact::model

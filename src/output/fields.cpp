#include "output/fields.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/physics.h"
#include "output/dictionary.h"

namespace thermocontact::output {
namespace {

constexpr std::int32_t open = 0, stick = 1, slip = 2;

/// VTK's cell type and its order of nodes, as Basix numbers.
struct VtkCell {
    std::uint8_t type;
    std::vector<std::size_t> nodes;
};

VtkCell vtk_cell(const std::string& cell, int degree) {
    static const std::map<std::pair<std::string, int>, VtkCell> cells = {
        {{"interval", 1}, {3, {0, 1}}},
        {{"interval", 2}, {21, {0, 1, 2}}},
        {{"triangle", 1}, {5, {0, 1, 2}}},
        {{"triangle", 2}, {22, {0, 1, 2, 5, 3, 4}}},
        {{"quadrilateral", 1}, {9, {0, 1, 3, 2}}},
        {{"quadrilateral", 2}, {28, {0, 1, 3, 2, 4, 6, 7, 5, 8}}},
        {{"tetrahedron", 1}, {10, {0, 1, 2, 3}}},
        {{"tetrahedron", 2}, {24, {0, 1, 2, 3, 9, 6, 8, 7, 5, 4}}},
        {{"hexahedron", 1}, {12, {0, 1, 3, 2, 4, 5, 7, 6}}},
        {{"hexahedron", 2}, {29, {0,  1,  3,  2,  4,  5,  7,  6,  8,  11, 13, 9,  16, 18,
                                  19, 17, 10, 12, 15, 14, 22, 23, 21, 24, 20, 25, 26}}}};
    return cells.at({cell, degree});
}

std::string facet_cell(const mesh::Mesh& mesh) {
    return mesh.dimension == 2 ? "interval" : mesh.cell == "tetrahedron" ? "triangle" : "quadrilateral";
}

VtuArray body_array(const std::string& name, std::vector<double> values) {
    return {name, declared(Place::body, name).components, std::move(values)};
}

VtuIntegers contact_integers(const std::string& name, std::vector<std::int32_t> values) {
    return {declared(Place::contact, name).name, std::move(values)};
}

/// The array of that name, made with zeros [points][components] if it is new: surfaces without the law keep
/// them.
VtuArray& array_in(VtuGrid& grid, const std::string& name) {
    const int components = declared(Place::contact, name).components;
    const auto found = std::ranges::find(grid.point_data, name, &VtuArray::name);
    if (found != grid.point_data.end()) {
        return *found;
    }
    const std::size_t points = grid.points.size() / 3;
    grid.point_data.push_back(
        {name, components, std::vector<double>(points * static_cast<std::size_t>(components), 0.0)});
    return grid.point_data.back();
}

double norm(const double* vector, std::size_t size) {
    double squares = 0;
    for (std::size_t i = 0; i < size; ++i) {
        squares += vector[i] * vector[i];
    }
    return std::sqrt(squares);
}

}  // namespace

std::vector<double> three_components(const std::vector<double>& values, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<double> result(values.size() / d * 3, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        result[i / d * 3 + i % d] = values[i];
    }
    return result;
}

FieldGrids::FieldGrids(const scene::Scene& scene, march::Simulation& simulation)
    : scene_(&scene),
      simulation_(&simulation),
      names_(scene.output.fields.begin(), scene.output.fields.end()),
      has_contact_(wants("contact") && !simulation.surfaces().empty()) {
    if (scene.material && (wants("stress") || wants("von_mises"))) {
        const march::State& state = simulation.state();
        stress_.emplace(scene, simulation.mesh(), simulation.space(), state.displacement, state.velocity,
                        state.temperature);
    }
}

VtuGrid FieldGrids::body_cells() const {
    const fem::Space& space = simulation_->space();
    const VtkCell cell = vtk_cell(simulation_->mesh().cell, scene_->degree);
    VtuGrid grid{{}, cell.type, static_cast<int>(cell.nodes.size()), {}, {}, {}, {}, {}};
    for (const mesh::Point& x : space.nodes) {
        grid.points.insert(grid.points.end(), x.begin(), x.end());
    }
    for (std::int32_t i = 0; i < simulation_->mesh().cell_count(); ++i) {
        for (const std::size_t node : cell.nodes) {
            grid.connectivity.push_back(space.dofmap.of(i)[node]);
        }
    }
    return grid;
}

VtuGrid FieldGrids::body() {
    VtuGrid grid = body_cells();
    const march::State& state = simulation_->state();
    if (scene_->material && wants("displacement")) {
        grid.point_data.push_back(
            body_array("displacement", three_components(state.displacement, scene_->dimension)));
    }
    if (scene_->material && wants("velocity")) {
        grid.point_data.push_back(
            body_array("velocity", three_components(state.velocity, scene_->dimension)));
    }
    if (scene_->heat && wants("temperature")) {
        grid.point_data.push_back(body_array("temperature", state.temperature));
    }
    if (stress_ && wants("stress")) {
        grid.cell_data.push_back(body_array("stress", stress_->mean_stress()));
    }
    if (stress_ && wants("von_mises")) {
        grid.cell_data.push_back(body_array("von_mises", stress_->von_mises()));
    }
    return grid;
}

VtuGrid FieldGrids::contact_cells() const {
    const fem::Space& space = simulation_->space();
    const VtkCell cell = vtk_cell(facet_cell(simulation_->mesh()), scene_->degree);
    VtuGrid grid{{}, cell.type, static_cast<int>(cell.nodes.size()), {}, {}, {}, {}, {}};
    grid.cell_integers.push_back(contact_integers("boundary", {}));
    std::int32_t boundary = 0;
    for (const auto& surface : simulation_->surfaces()) {
        for (const mesh::Facet& facet : surface->facets) {
            const auto first = static_cast<std::int64_t>(grid.points.size() / 3);
            for (const std::int32_t node : space.facet_nodes(facet)) {
                const mesh::Point& x = space.nodes[static_cast<std::size_t>(node)];
                grid.points.insert(grid.points.end(), x.begin(), x.end());
            }
            for (const std::size_t node : cell.nodes) {
                grid.connectivity.push_back(first + static_cast<std::int64_t>(node));
            }
            grid.cell_integers.front().values.push_back(boundary);
        }
        ++boundary;
    }
    return grid;
}

void FieldGrids::add_surface(std::size_t index, VtuGrid& grid, std::size_t first, std::size_t count) {
    const model::ContactSurface& surface = *simulation_->surfaces()[index];
    const auto d = static_cast<std::size_t>(scene_->dimension);
    model::FacetFields fields = simulation_->probe(index).fields();
    const double epsilon = surface.laws.friction ? surface.laws.friction->regularisation : -1.0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool slips =
            surface.multiplier ? fields["slips"][i] > 0 : norm(&fields["slip_velocity"][i * d], d) > epsilon;
        grid.point_integers.front().values[first + i] = fields["gap"][i] > 0 ? open : slips ? slip : stick;
    }
    fields.erase("slips");
    if (!scene_->material) {
        fields.erase("slip_velocity");
    }
    for (const auto& [name, values] : fields) {
        VtuArray& array = array_in(grid, name);
        const std::vector<double> stored =
            array.components == 3 ? three_components(values, scene_->dimension) : values;
        std::ranges::copy(stored,
                          array.values.begin() + static_cast<std::ptrdiff_t>(first) * array.components);
    }
}

VtuGrid FieldGrids::contact() {
    VtuGrid grid = contact_cells();
    grid.point_integers.push_back(
        contact_integers("state", std::vector<std::int32_t>(grid.points.size() / 3)));
    std::size_t first = 0;
    for (std::size_t i = 0; i < simulation_->surfaces().size(); ++i) {
        const std::size_t count =
            simulation_->surfaces()[i]->facets.size() * static_cast<std::size_t>(grid.nodes_per_cell);
        add_surface(i, grid, first, count);
        first += count;
    }
    return grid;
}

}  // namespace thermocontact::output

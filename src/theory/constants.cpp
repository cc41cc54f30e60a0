#include "theory/constants.h"

#include <algorithm>
#include <cmath>

#include "model/loads.h"
#include "model/nodal.h"
#include "model/physics.h"
#include "theory/energy_space.h"
#include "theory/rigid_motions.h"
#include "theory/trace_matrix.h"

namespace thermocontact::theory {
namespace {

/// The facets of all contact boundaries with that law.
template <typename Law>
std::vector<mesh::Facet> facets_with(const scene::Scene& scene, const mesh::Mesh& mesh,
                                     std::optional<Law> scene::Contact::*law) {
    std::vector<mesh::Facet> result;
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.contact && (*boundary.contact).*law) {
            const std::vector<mesh::Facet> facets = model::facets_of(mesh, name);
            result.insert(result.end(), facets.begin(), facets.end());
        }
    }
    return result;
}

/// Gram matrices (forms/norms.py) of fields with `components` at each node.
struct Norms {
    const mesh::Mesh& mesh;
    const fem::Space& space;
    const fem::NodeGraph& graph;
    int components;

    fem::Form form(const std::string& name) const {
        return {fem::find_kernel("norms." + name, mesh.cell, space.element.degree), mesh, {}};
    }
    fem::BlockMatrix of(const std::string& name) const {
        return fem::assemble_matrix(form(name), space, graph, components, components);
    }
    Eigenvalue largest(const std::string& name, EnergySpace& fields) const {
        const fem::BlockMatrix gram = of(name);
        return fields.largest_quotient([&](const auto& x, auto& y) { gram.multiply(x, y); });
    }
    Eigenvalue largest_trace(const std::string& name, const std::vector<mesh::Facet>& facets,
                             EnergySpace& fields) const {
        const TraceMatrix trace(form(name), facets, space.dofmap, components);
        return fields.largest_quotient([&](const auto& x, auto& y) { trace.multiply(x, y); });
    }
};

/// The value, its error noted. The constants are square roots, which halves it.
double noted(const Eigenvalue& found, Constants& constants) {
    constants.relative_error = std::max(constants.relative_error, found.residual / 2);
    return found.value;
}

void find_mechanical(const scene::Scene& scene, const Norms& norms, Constants& constants) {
    const auto prescribed = model::Prescribed::displacement(scene, norms.mesh, norms.space);
    EnergySpace V(norms.of("strains"), prescribed.fixed(),
                  held_rigidly(norms.space, prescribed.fixed(), scene.dimension));
    constants.c_k = 1 / std::sqrt(1 + noted(norms.largest("velocity", V), constants));
    if (model::has_compliance(scene)) {
        const auto facets = facets_with(scene, norms.mesh, &scene::Contact::compliance);
        constants.s1 = std::sqrt(noted(norms.largest_trace("velocity_trace", facets, V), constants));
    }
}

void find_thermal(const scene::Scene& scene, const Norms& norms, Constants& constants) {
    const auto prescribed = model::Prescribed::temperature(scene, norms.mesh, norms.space);
    EnergySpace Q(norms.of("gradients"), prescribed.fixed(), !prescribed.dofs().empty());
    constants.c_f = 1 / std::sqrt(noted(norms.largest("temperature", Q), constants));
    if (model::has_conductance(scene)) {
        const auto facets = facets_with(scene, norms.mesh, &scene::Contact::conductance);
        constants.s2 = std::sqrt(noted(norms.largest_trace("temperature_trace", facets, Q), constants));
    }
}

}  // namespace

Constants find_constants(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space) {
    const fem::NodeGraph graph = fem::make_node_graph(space);
    Constants constants;
    if (scene.material) {
        find_mechanical(scene, {mesh, space, graph, scene.dimension}, constants);
    }
    if (scene.heat) {
        find_thermal(scene, {mesh, space, graph, 1}, constants);
    }
    return constants;
}

}  // namespace thermocontact::theory

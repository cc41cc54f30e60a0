#include "theory/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/loads.h"
#include "model/nodal.h"
#include "model/physics.h"
#include "model/springs.h"
#include "theory/energy_space.h"
#include "theory/law_bounds.h"
#include "theory/rigid_motions.h"
#include "theory/trace_matrix.h"

namespace thermocontact::theory {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Facets, and for each the number of its boundary's law.
struct WeightedFacets {
    std::vector<mesh::Facet> facets;
    std::vector<double> weights;
};

/// Those of all contact boundaries with that law.
template <typename Law, typename Weight>
WeightedFacets facets_with(const scene::Scene& scene, const mesh::Mesh& mesh,
                           std::optional<Law> scene::Contact::*law, Weight weight) {
    WeightedFacets result;
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.contact && (*boundary.contact).*law) {
            const std::vector<mesh::Facet> facets = model::facets_of(mesh, name);
            result.facets.insert(result.facets.end(), facets.begin(), facets.end());
            result.weights.resize(result.facets.size(), weight(bounds_of_laws(name, boundary)));
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
    /// The body's operator of that name, each cell with its own material.
    fem::BlockMatrix operator_of(const scene::Scene& scene, const std::string& name) const {
        auto kernel = fem::kernel_in_force(name, mesh.cell, space.element.degree, scene.kernels);
        return fem::assemble_matrix(
            fem::Form::by_region(std::move(kernel), mesh, model::body_constants(scene, mesh)), space, graph,
            components, components);
    }
    Eigenvalue largest_trace(const std::string& name, const std::vector<mesh::Facet>& facets,
                             EnergySpace& fields, const std::vector<double>& weights = {}) const {
        const TraceMatrix trace(form(name), facets, space.dofmap, components, weights);
        return fields.largest_quotient([&](const auto& x, auto& y) { trace.multiply(x, y); });
    }
};

/// The value, its error noted. The constants are square roots, which halves it.
double noted(const Eigenvalue& found, Constants& constants) {
    constants.relative_error = std::max(constants.relative_error, found.residual / 2);
    return found.value;
}

/// Weights of laws that are not Lipschitz are infinite, and then so is their quotient.
double weighted_quotient(const Norms& norms, const std::string& trace, const WeightedFacets& laws,
                         EnergySpace fields, Constants& constants) {
    if (std::ranges::count(laws.weights, infinity) > 0) {
        return infinity;
    }
    return noted(norms.largest_trace(trace, laws.facets, fields, laws.weights), constants);
}

void find_mechanical(const scene::Scene& scene, const std::vector<Piece>& pieces, const Norms& norms,
                     Constants& constants) {
    const auto prescribed = model::Prescribed::displacement(scene, norms.mesh, norms.space);
    const bool held = held_rigidly(norms.space, prescribed.fixed(), scene.dimension);
    EnergySpace V(norms.of("strains"), prescribed.fixed(), held);
    constants.c_k = 1 / std::sqrt(1 + noted(norms.largest("velocity", V), constants));
    if (model::has_compliance(scene)) {
        const auto laws = facets_with(scene, norms.mesh, &scene::Contact::compliance,
                                      [](const LawBounds& bounds) { return bounds.L_nu + bounds.L_tau; });
        constants.s1 = std::sqrt(noted(norms.largest_trace("velocity_trace", laws.facets, V), constants));
        if (elasticity_elliptic(pieces) && !bounds_of_laws(scene).own_contact) {
            const model::Springs springs(scene, norms.mesh, norms.space);
            fem::BlockMatrix operators = norms.operator_of(scene, "elasticity.stiffness");
            springs.add_to(1.0, operators);
            const bool sprung =
                held || held_rigidly(norms.space, prescribed.fixed(), scene.dimension, &springs);
            EnergySpace stored(std::move(operators), prescribed.fixed(), sprung);
            constants.r_a = weighted_quotient(norms, "velocity_trace", laws, std::move(stored), constants);
        }
    }
}

void find_thermal(const scene::Scene& scene, const std::vector<Piece>& pieces, const Norms& norms,
                  Constants& constants) {
    const auto prescribed = model::Prescribed::temperature(scene, norms.mesh, norms.space);
    const bool held = !prescribed.dofs().empty();
    EnergySpace Q(norms.of("gradients"), prescribed.fixed(), held);
    constants.c_f = 1 / std::sqrt(noted(norms.largest("temperature", Q), constants));
    if (model::has_conductance(scene)) {
        const auto laws = facets_with(scene, norms.mesh, &scene::Contact::conductance,
                                      [](const LawBounds& bounds) { return bounds.M_kc; });
        constants.s2 = std::sqrt(noted(norms.largest_trace("temperature_trace", laws.facets, Q), constants));
        if (conductivity_elliptic(pieces) && !bounds_of_laws(scene).own_exchange) {
            EnergySpace conducted(norms.operator_of(scene, "conduction.conduction"), prescribed.fixed(),
                                  held);
            constants.r_d =
                weighted_quotient(norms, "temperature_trace", laws, std::move(conducted), constants);
        }
    }
}

}  // namespace

Constants find_constants(const scene::Scene& scene, const std::vector<Piece>& pieces, const mesh::Mesh& mesh,
                         const fem::Space& space) {
    const fem::NodeGraph graph = fem::make_node_graph(space);
    Constants constants;
    if (scene.material) {
        find_mechanical(scene, pieces, {mesh, space, graph, scene.dimension}, constants);
    }
    if (scene.heat) {
        find_thermal(scene, pieces, {mesh, space, graph, 1}, constants);
    }
    return constants;
}

}  // namespace thermocontact::theory

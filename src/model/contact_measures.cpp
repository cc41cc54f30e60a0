#include "model/contact_measures.h"

#include <algorithm>
#include <cmath>

#include "fem/block_matrix.h"
#include "model/physics.h"

namespace thermocontact::model {

ContactProbe::ContactProbe(const ContactSurface& surface, const mesh::Mesh& mesh, const fem::Space& space,
                           int dimension, const ContactState& state)
    : surface_(&surface), space_(&space), dimension_(dimension) {
    const fem::Field displacement{state.displacement, dimension, &space.dofmap};
    const fem::Field velocity{state.velocity, dimension, &space.dofmap};
    fem::Fields fields{{"u", displacement},
                       {"u_old", displacement},
                       {"w", velocity},
                       {"g", {&surface.gap, 1, &space.dofmap}},
                       {"theta", {state.temperature, 1, &space.dofmap}},
                       {"theta_F", {&surface.foundation_temperature, 1, &space.dofmap}}};
    // with k = 0 the displacement u_old + k w of the contact forms is the current one
    const fem::Constants constants = contact_constants(surface.laws, 0.0);
    for (const char* name : {"area", "closed_area", "slip_area", "node_area", "gap", "slip_velocity"}) {
        add(std::string("kinematics.") + name, mesh, constants, fields);
    }
    if (surface.laws.compliance) {
        add("compliance.normal_force", mesh, constants, fields);
        add("compliance.pressure", mesh, constants, fields);
    }
    if (surface.laws.friction) {
        add("friction.residual", mesh, constants, fields);
        add("friction.traction", mesh, constants, fields);
    }
    if (surface.laws.conductance) {
        add("conductance.residual", mesh, constants, fields);
        add("conductance.heat_flow", mesh, constants, fields);
    }
}

void ContactProbe::add(const std::string& name, const mesh::Mesh& mesh, const fem::Constants& constants,
                       const fem::Fields& fields) {
    auto kernel = fem::find_kernel(name, mesh.cell, space_->element.degree);
    forms_[name] = std::make_unique<fem::Form>(std::move(kernel), mesh, constants, fields, surface_->rule);
}

double ContactProbe::resultant(const std::string& name, int components) {
    std::vector<double> sum(static_cast<std::size_t>(components), 0.0);
    std::vector<double> tensor(static_cast<std::size_t>(space_->dofmap.nodes_per_cell * components));
    for (const mesh::Facet& facet : surface_->facets) {
        std::ranges::fill(tensor, 0.0);
        form(name).add_facet(facet, tensor);
        for (std::size_t i = 0; i < tensor.size(); ++i) {
            sum[i % sum.size()] += tensor[i];
        }
    }
    double squares = 0;
    for (const double value : sum) {
        squares += value * value;
    }
    return components == 1 ? sum[0] : std::sqrt(squares);
}

ContactMeasures ContactProbe::measure() {
    ContactMeasures result;
    result.area = fem::integrate(form("kinematics.area"), surface_->facets);
    result.contact_fraction = fem::integrate(form("kinematics.closed_area"), surface_->facets) / result.area;
    result.slip_fraction = fem::integrate(form("kinematics.slip_area"), surface_->facets) / result.area;
    for (const double gap : at_nodes("kinematics.gap", 1)) {
        result.max_penetration = std::max(result.max_penetration, -gap);
    }
    if (surface_->laws.compliance) {
        result.normal_force = fem::integrate(form("compliance.normal_force"), surface_->facets);
    }
    if (surface_->laws.friction) {
        result.tangential_force = resultant("friction.residual", dimension_);
    }
    if (surface_->laws.conductance) {
        result.heat_flow = resultant("conductance.residual", 1);
    }
    return result;
}

std::vector<double> ContactProbe::at_nodes(const std::string& name, int components) {
    const auto c = static_cast<std::size_t>(components);
    const auto n = static_cast<std::size_t>(space_->dofmap.nodes_per_cell);
    std::vector<double> weights(n), tensor(n * c), values;
    for (const mesh::Facet& facet : surface_->facets) {
        std::ranges::fill(weights, 0.0);
        std::ranges::fill(tensor, 0.0);
        form("kinematics.node_area").add_facet(facet, weights);
        form(name).add_facet(facet, tensor);
        for (const int node : space_->element.facet_nodes[static_cast<std::size_t>(facet.local)]) {
            for (std::size_t i = 0; i < c; ++i) {
                values.push_back(tensor[static_cast<std::size_t>(node) * c + i] /
                                 weights[static_cast<std::size_t>(node)]);
            }
        }
    }
    return values;
}

FacetFields ContactProbe::fields() {
    FacetFields result;
    result["gap"] = at_nodes("kinematics.gap", 1);
    result["slip_velocity"] = at_nodes("kinematics.slip_velocity", dimension_);
    if (surface_->laws.compliance) {
        result["pressure"] = at_nodes("compliance.pressure", 1);
    }
    if (surface_->laws.friction) {
        result["traction"] = at_nodes("friction.traction", dimension_);
    }
    if (surface_->laws.conductance) {
        result["heat_flow"] = at_nodes("conductance.heat_flow", 1);
    }
    return result;
}

}  // namespace thermocontact::model

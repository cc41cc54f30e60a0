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
                       {"v_F", surface.velocity_of_foundation(space, dimension)},
                       {"g", {&surface.gap, 1, &space.dofmap}},
                       {"theta", {state.temperature, 1, &space.dofmap}},
                       {"theta_F", {&surface.foundation_temperature, 1, &space.dofmap}}};
    // with k = 0 the displacement u_old + k w of the contact forms is the current one
    const fem::Constants constants = contact_constants(surface.laws, 0.0);
    if (surface.multiplier) {
        fields["lam"] = surface.multiplier->on_facet();
        slips_ = "coulomb.";
        tangential_force_ = "coulomb.force";
        traction_ = "coulomb.traction";
        add("coulomb.slips", mesh, constants, fields);
    }
    for (const char* name : {"area", "closed_area", "node_area", "gap", "slip_velocity"}) {
        add(std::string("kinematics.") + name, mesh, constants, fields);
    }
    add(slips_ + "slip_area", mesh, constants, fields);
    if (surface.laws.compliance) {
        add("compliance.normal_force", mesh, constants, fields);
        add("compliance.pressure", mesh, constants, fields);
    }
    if (surface.laws.friction) {
        add(tangential_force_, mesh, constants, fields);
        add(traction_, mesh, constants, fields);
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

template <typename Visit>
void ContactProbe::for_facets(const std::string& name, Visit&& visit) {
    fem::Form& of_name = form(name);
    if (surface_->multiplier) {
        of_name.set_constant("gamma", surface_->multiplier->slip_stiffness);
    }
    for (std::size_t i = 0; i < surface_->facets.size(); ++i) {
        if (surface_->multiplier) {
            surface_->multiplier->show(i);
        }
        visit(surface_->facets[i], of_name);
    }
}

double ContactProbe::integral(const std::string& name) {
    double sum = 0;
    for_facets(name, [&](const mesh::Facet& facet, fem::Form& of_name) {
        of_name.add_facet(facet, {&sum, 1});
    });
    return sum;
}

std::array<double, 3> ContactProbe::resultant(const std::string& name, std::size_t components) {
    std::array<double, 3> sum{};
    std::vector<double> tensor(static_cast<std::size_t>(space_->dofmap.nodes_per_cell) * components);
    for_facets(name, [&](const mesh::Facet& facet, fem::Form& of_name) {
        std::ranges::fill(tensor, 0.0);
        of_name.add_facet(facet, tensor);
        for (std::size_t i = 0; i < tensor.size(); ++i) {
            sum[i % components] += tensor[i];
        }
    });
    return sum;
}

ContactMeasures ContactProbe::measure(const parallel::Team& team) {
    struct Sums {
        double area, closed, slipping, normal, heat;
        std::array<double, 3> tangential;
    };
    Sums here{integral("kinematics.area"),
              integral("kinematics.closed_area"),
              integral(slips_ + "slip_area"),
              0,
              0,
              {}};
    double deepest = 0;
    for (const double gap : at_nodes("kinematics.gap", 1)) {
        deepest = std::max(deepest, -gap);
    }
    if (surface_->laws.compliance) {
        here.normal = integral("compliance.normal_force");
    }
    if (surface_->laws.friction) {
        here.tangential = resultant(tangential_force_, static_cast<std::size_t>(dimension_));
    }
    if (surface_->laws.conductance) {
        here.heat = resultant("conductance.residual", 1)[0];
    }
    const Sums all = team.summed(here);
    const auto& t = all.tangential;
    return {all.normal,
            std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]),
            team.max(deepest),
            all.closed / all.area,
            all.slipping / all.area,
            all.heat,
            all.area};
}

std::vector<double> ContactProbe::at_nodes(const std::string& name, int components) {
    const auto c = static_cast<std::size_t>(components);
    const auto n = static_cast<std::size_t>(space_->dofmap.nodes_per_cell);
    std::vector<double> weights(n), tensor(n * c), values;
    for_facets(name, [&](const mesh::Facet& facet, fem::Form& of_name) {
        std::ranges::fill(weights, 0.0);
        std::ranges::fill(tensor, 0.0);
        form("kinematics.node_area").add_facet(facet, weights);
        of_name.add_facet(facet, tensor);
        for (const int node : space_->element.facet_nodes[static_cast<std::size_t>(facet.local)]) {
            for (std::size_t i = 0; i < c; ++i) {
                values.push_back(tensor[static_cast<std::size_t>(node) * c + i] /
                                 weights[static_cast<std::size_t>(node)]);
            }
        }
    });
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
        result["traction"] = at_nodes(traction_, dimension_);
    }
    if (surface_->multiplier) {
        result["slips"] = at_nodes("coulomb.slips", 1);
    }
    if (surface_->laws.conductance) {
        result["heat_flow"] = at_nodes("conductance.heat_flow", 1);
    }
    return result;
}

}  // namespace thermocontact::model

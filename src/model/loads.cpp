#include "model/loads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "error.h"
#include "model/law_samples.h"
#include "model/nodal.h"
#include "model/pieces.h"
#include "number.h"

namespace thermocontact::model {

std::vector<mesh::Facet> facets_of(const mesh::Mesh& mesh, const std::string& boundary) {
    std::vector<mesh::Facet> result;
    std::ranges::copy_if(mesh.facets, std::back_inserter(result), [&](const mesh::Facet& facet) {
        return mesh.boundary_names[static_cast<std::size_t>(facet.boundary)] == boundary;
    });
    return result;
}

Loads::Loads(const mesh::Mesh& mesh, const fem::Space& space, int components)
    : mesh_(&mesh),
      space_(&space),
      components_(components),
      constant_(space.nodes.size() * static_cast<std::size_t>(components), 0.0) {}

Loads Loads::mechanical(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                        const std::vector<Source>& sources) {
    Loads loads(mesh, space, scene.dimension);
    if (!scene.body_force.empty()) {
        loads.add("body_force.load", "f", scene.body_force, AllCells{});
    }
    if (scene.own_body_force) {
        loads.add_own("body_force.load", scene, *scene.own_body_force, {body_force_constants(scene)});
    }
    for (const auto& [name, boundary] : scene.boundaries) {
        if (!boundary.traction.empty()) {
            loads.add("traction.load", "f", boundary.traction, facets_of(mesh, name));
        }
    }
    std::ranges::for_each(sources, [&](const Source& source) { loads.add(source); });
    return loads;
}

Loads Loads::thermal(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                     const std::vector<Source>& sources) {
    Loads loads(mesh, space, 1);
    loads.add_sources(scene);
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.heat_flux) {
            loads.add("heat_flux.load", "flux", {*boundary.heat_flux}, facets_of(mesh, name));
        }
    }
    std::ranges::for_each(sources, [&](const Source& source) { loads.add(source); });
    return loads;
}

Loads Loads::ambient(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space) {
    Loads loads(mesh, space, 1);
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.convection) {
            loads.add("convection.ambient", "theta_a", {boundary.convection->ambient_temperature},
                      facets_of(mesh, name), {{"h", {boundary.convection->coefficient}}});
        }
    }
    return loads;
}

/// The heat source of each region on its cells, and the scene's own on the others.
void Loads::add_sources(const scene::Scene& scene) {
    if (scene.heat->own_source) {
        add_own("heat_source.load", scene, *scene.heat->own_source, source_constants(scene, *mesh_));
        return;
    }
    auto cells = cells_by_laws(scene, *mesh_);
    for (const auto& [name, region] : scene.regions) {
        if (region.heat && region.heat->source) {
            add("heat_source.load", "q0", {*region.heat->source}, cells[name]);
        }
    }
    if (scene.heat->source) {
        add("heat_source.load", "q0", {*scene.heat->source},
            scene.regions.empty() ? Domain(AllCells{}) : Domain(cells[""]));
    }
}

/// The nodes that the expressions of a term matter at.
std::vector<std::int32_t> Loads::nodes_of(const Domain& domain) const {
    std::vector<std::int32_t> nodes;
    if (const Facets* facets = std::get_if<Facets>(&domain)) {
        // off the facets the shape functions vanish on them, so their values do not matter
        for (const mesh::Facet& facet : *facets) {
            const auto of_facet = space_->facet_nodes(facet);
            nodes.insert(nodes.end(), of_facet.begin(), of_facet.end());
        }
        std::ranges::sort(nodes);
        const auto repeated = std::unique(nodes.begin(), nodes.end());
        nodes.erase(repeated, nodes.end());
    } else {
        nodes.resize(space_->nodes.size());
        std::iota(nodes.begin(), nodes.end(), 0);
    }
    return nodes;
}

void Loads::add(const std::string& kernel, const std::string& coefficient,
                std::vector<scene::Expression> expressions, Domain domain, const fem::Constants& constants) {
    auto term = std::make_unique<Term>();
    term->nodal.resize(constant_.size());
    term->nodes = nodes_of(domain);
    term->domain = std::move(domain);
    term->expressions = std::move(expressions);
    const fem::Fields fields{{coefficient, {&term->nodal, components_, &space_->dofmap}}};
    term->form = std::make_unique<fem::Form>(fem::find_kernel(kernel, mesh_->cell, space_->element.degree),
                                             *mesh_, constants, fields);
    const bool varies = depends_on_time(term->expressions);
    keep(std::move(term), varies);
}

/// The law of a file over all cells: its regions differ in parameters.
void Loads::add_own(const std::string& kernel, const scene::Scene& scene, const scene::Law& law,
                    const std::vector<fem::Constants>& constants) {
    auto term = std::make_unique<Term>();
    const fem::Kernel own = fem::find_kernel(kernel, mesh_->cell, space_->element.degree, scene.kernels);
    term->law = place_of(law);
    term->form = std::make_unique<fem::Form>(fem::Form::by_region(own, *mesh_, constants));
    keep(std::move(term), std::ranges::count(own.constants, "t") > 0);
}

void Loads::add(const Source& source) {
    auto term = std::make_unique<Term>();
    if (!source.boundary.empty()) {
        term->domain = facets_of(*mesh_, source.boundary);
    }
    term->form = std::make_unique<fem::Form>(source.kernel, *mesh_, fem::Constants{{"t", {0.0}}});
    keep(std::move(term), std::ranges::count(source.kernel.constants, "t") > 0);
}

void Loads::keep(std::unique_ptr<Term> term, bool varies) {
    if (varies) {
        varying_.push_back(std::move(term));
    } else {
        assemble(*term, 0.0, constant_);
    }
}

void Loads::assemble(Term& term, double t, std::vector<double>& vector) {
    term.form->set_constant("t", t);
    interpolate_at(*space_, term.expressions, term.nodes, t, term.nodal);
    if (const Cells* cells = std::get_if<Cells>(&term.domain)) {
        fem::assemble_cells(*term.form, *cells, space_->dofmap, components_, vector);
    } else if (const Facets* facets = std::get_if<Facets>(&term.domain)) {
        fem::assemble_facets(*term.form, *facets, space_->dofmap, components_, vector);
    } else {
        fem::assemble_cells(*term.form, space_->dofmap, components_, vector);
    }
    if (!term.law.empty() &&
        !std::ranges::all_of(vector, [](double value) { return std::isfinite(value); })) {
        throw NumericsError(term.law + ": no finite number at t = " + short_text(t));
    }
}

const std::vector<double>& Loads::at(double t) {
    if (varying_.empty()) {
        return constant_;
    }
    sum_ = constant_;
    for (const auto& term : varying_) {
        assemble(*term, t, sum_);
    }
    return sum_;
}

}  // namespace thermocontact::model

#include "plan/difference.h"

#include <algorithm>
#include <cmath>

#include "march/vectors.h"
#include "mesh/shapes.h"

namespace thermocontact::plan {
namespace {

Domain make_domain(const scene::Scene& scene) {
    mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    fem::Space space = fem::make_space(mesh, scene.degree);
    return {scene.mesh, std::move(mesh), std::move(space)};
}

march::Nodal subtract(const march::Nodal& a, const march::Nodal& b) {
    march::Nodal result(b.size());
    std::ranges::transform(a, b, result.begin(), std::minus<>());
    return result;
}

void take_largest(std::vector<double>& largest, const std::vector<double>& values) {
    largest.resize(values.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        largest[i] = std::max(largest[i], values[i]);
    }
}

}  // namespace

Norms::Norms(const scene::Scene& scene, const std::vector<std::string>& components)
    : domain_(make_domain(scene)), graph_(fem::make_node_graph(domain_.space)) {
    const auto add = [&](march::Nodal Frame::*field, const std::string& form, int columns) {
        fem::Kernel kernel = fem::find_kernel(form, domain_.mesh.cell, domain_.space.element.degree);
        fem::Form bound(std::move(kernel), domain_.mesh, {});
        terms_.push_back(
            {field, fem::assemble_matrix(std::move(bound), domain_.space, graph_, columns, columns)});
        terms_.back().gram.compress();
    };
    for (const std::string& component : components) {
        if (component == "velocity") {
            add(&Frame::velocity, "norms.velocity", scene.dimension);
        } else if (component == "strain") {
            add(&Frame::displacement, "norms.strains", scene.dimension);
        } else if (component == "temperature") {
            add(&Frame::temperature, "norms.temperature", 1);
        }
    }
}

std::vector<double> Norms::of(const Frame& frame) const {
    std::vector<double> result;
    for (const Term& term : terms_) {
        march::Nodal values = frame.*term.field;
        if (term.field == &Frame::displacement) {  // a translation strains nothing, but costs digits
            march::centre(values, term.gram.columns);
        }
        result.push_back(std::sqrt(std::max(0.0, term.gram.quadratic_form(values))));
    }
    return result;
}

Comparison::Comparison(const scene::Scene& scene, Quantity quantity)
    : scene_(&scene), quantity_(quantity), components_(components_of(quantity, scene)) {}

const Norms& Comparison::norms_of(const Discretisation& discretisation) {
    std::unique_ptr<Norms>& norms = norms_[{kind_of_mesh(discretisation), discretisation.scale}];
    if (norms == nullptr) {
        norms = std::make_unique<Norms>(discretised(*scene_, discretisation), components_);
    }
    return *norms;
}

std::vector<double> Comparison::difference(const Pilot& coarse, const Pilot& fine) {
    std::vector<double> largest;
    const bool same_mesh = coarse.discretisation.scale == fine.discretisation.scale &&
                           kind_of_mesh(coarse.discretisation) == kind_of_mesh(fine.discretisation);
    std::optional<Transfer> transfer;
    if (quantity_ == Quantity::norms && !same_mesh) {
        transfer.emplace(norms_of(coarse.discretisation).domain(), norms_of(fine.discretisation).domain());
    }
    const auto moved = [&](const march::Nodal& values, int components) {
        return transfer ? (*transfer)(values, components) : values;
    };
    for (std::size_t i = 0; i < fine.frames.size(); ++i) {
        const Frame &a = coarse.frames[i], &b = fine.frames[i];
        if (quantity_ != Quantity::norms) {
            take_largest(largest, {std::abs(a.value - b.value)});
            continue;
        }
        const int d = scene_->dimension;
        const Frame apart{subtract(moved(a.displacement, d), b.displacement),
                          subtract(moved(a.velocity, d), b.velocity),
                          subtract(moved(a.temperature, 1), b.temperature)};
        take_largest(largest, norms_of(fine.discretisation).of(apart));
    }
    return largest;
}

std::vector<double> Comparison::size(const Pilot& run) {
    std::vector<double> largest;
    for (const Frame& frame : run.frames) {
        if (quantity_ == Quantity::norms) {
            take_largest(largest, norms_of(run.discretisation).of(frame));
        } else {
            take_largest(largest, {std::abs(frame.value)});
        }
    }
    return largest;
}

}  // namespace thermocontact::plan

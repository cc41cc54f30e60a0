#include "fem/facet_form.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace thermocontact::fem {
namespace {

/// A few numbers, for which a call of the C library's takes longer than they do. Returns the end of `to`.
inline double* copy_few(const double* from, std::ptrdiff_t count, double* to) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        to[i] = from[i];
    }
    return to + count;
}

}  // namespace

FacetNodes::FacetNodes(const Space& space, const std::vector<mesh::Facet>& facets)
    : facets_(&facets),
      by_local_(&space.element.facet_nodes),
      per_facet_(space.element.facet_nodes.front().size()) {
    nodes_.reserve(facets.size() * per_facet_);
    for (std::size_t facet = 0; facet < facets.size(); ++facet) {
        const auto of_cell = space.dofmap.of(facets[facet].cell);
        for (const int node : in_cell(facet)) {
            nodes_.push_back(of_cell[static_cast<std::size_t>(node)]);
        }
    }
}

FacetForm::FacetForm(Form form, const Space& space, const mesh::Mesh& mesh, const FacetNodes& nodes,
                     int components)
    : form_(std::move(form)),
      nodes_(&nodes),
      components_(static_cast<std::size_t>(components)),
      cell_nodes_(static_cast<std::size_t>(space.dofmap.nodes_per_cell)) {
    const std::size_t facets = nodes.facets().size(), of_facet = nodes.per_facet() * components_,
                      of_cell = cell_nodes_ * components_;
    for (const mesh::Facet& facet : nodes.facets()) {
        for (const std::int32_t vertex : mesh.vertices_of(facet.cell)) {
            const mesh::Point& x = mesh.points[static_cast<std::size_t>(vertex)];
            coordinates_.insert(coordinates_.end(), x.begin(), x.end());
        }
    }
    std::size_t inputs = 0;
    for (const Field& field : form_.fields()) {
        inputs += field.dofmap == nullptr ? field.values->size()
                                          : nodes.per_facet() * static_cast<std::size_t>(field.components);
    }
    inputs_.resize(inputs);
    coefficients_.resize(form_.coefficient_count());
    const bool vector = form_.rank() == 1;
    entries_ = vector ? of_facet : of_facet * of_facet;
    cell_tensor_.resize(vector ? of_cell : of_cell * of_cell);
    results_.resize(vector ? facets * entries_ : entries_);
    if (vector) {
        inputs_then_.resize(facets * inputs);
        known_.resize(facets);
    }
}

void FacetForm::set_constant(const std::string& name, double value) {
    if (form_.set_constant(name, value)) {
        std::ranges::fill(known_, 0);
    }
}

void FacetForm::gather(std::size_t facet) {
    double* target = inputs_.data();
    for (const Field& field : form_.fields()) {
        const double* values = field.values->data();
        if (field.dofmap == nullptr) {
            target = std::copy_n(values, field.values->size(), target);
            continue;
        }
        for (const std::int32_t node : nodes_->of(facet)) {
            target = copy_few(values + std::ptrdiff_t{node} * field.components, field.components, target);
        }
    }
}

void FacetForm::spread(std::size_t facet) {
    std::ranges::fill(coefficients_, 0.0);
    const double* value = inputs_.data();
    double* target = coefficients_.data();
    for (const Field& field : form_.fields()) {
        if (field.dofmap == nullptr) {
            target = std::copy_n(value, field.values->size(), target);
            value += field.values->size();
            continue;
        }
        for (const int node : nodes_->in_cell(facet)) {
            copy_few(value, field.components, target + std::ptrdiff_t{node} * field.components);
            value += field.components;
        }
        target += std::ptrdiff_t{field.dofmap->nodes_per_cell} * field.components;
    }
}

void FacetForm::compute(std::size_t facet, double* result) {
    spread(facet);
    std::ranges::fill(cell_tensor_, 0.0);
    const std::size_t of_vertices = coordinates_.size() / nodes_->facets().size();
    form_.tabulate(nodes_->facets()[facet], coefficients_.data(), coordinates_.data() + facet * of_vertices,
                   cell_tensor_.data());
    const std::span<const int> in_cell = nodes_->in_cell(facet);
    const auto count = static_cast<std::ptrdiff_t>(components_);
    const auto take_row = [&](const double* row) {
        for (const int node : in_cell) {
            result = copy_few(row + node * count, count, result);
        }
    };
    if (form_.rank() == 1) {
        take_row(cell_tensor_.data());
        return;
    }
    const auto columns = static_cast<std::ptrdiff_t>(cell_nodes_ * components_);
    for (const int node : in_cell) {
        for (std::ptrdiff_t c = 0; c < count; ++c) {
            take_row(cell_tensor_.data() + (node * count + c) * columns);
        }
    }
}

std::span<const double> FacetForm::tensor(std::size_t facet) {
    gather(facet);
    if (known_.empty()) {
        compute(facet, results_.data());
        return results_;
    }
    double *const result = results_.data() + facet * entries_, *const then = inputs_then_.data() +
                                                                             facet * inputs_.size();
    const std::size_t bytes = inputs_.size() * sizeof(double);
    if (known_[facet] == 0 || std::memcmp(then, inputs_.data(), bytes) != 0) {
        compute(facet, result);
        std::memcpy(then, inputs_.data(), bytes);
        known_[facet] = 1;
    }
    return {result, entries_};
}

}  // namespace thermocontact::fem

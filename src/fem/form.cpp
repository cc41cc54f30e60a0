#include "fem/form.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace thermocontact::fem {
namespace {

template <typename Map>
const auto& bound(const Map& values, const std::string& name, const std::string& form) {
    const auto entry = values.find(name);
    if (entry == values.end()) {
        throw std::logic_error("form " + form + " needs " + name);
    }
    return entry->second;
}

std::vector<Tabulate> select(const std::vector<Integral>& integrals, int rule) {
    std::vector<Tabulate> calls;
    for (const Integral& integral : integrals) {
        if (integral.subdomain == -1 || integral.subdomain == rule) {
            calls.push_back(integral.tabulate);
        }
    }
    return calls;
}

}  // namespace

Form::Form(Kernel kernel, const mesh::Mesh& mesh, const Constants& constants, const Fields& fields, int rule)
    : Form(std::move(kernel), mesh, fields, rule, std::vector{constants}) {}

Form Form::by_region(Kernel kernel, const mesh::Mesh& mesh, const std::vector<Constants>& sets,
                     const Fields& fields, int rule) {
    return {std::move(kernel), mesh, fields, rule, sets};
}

Form::Form(Kernel kernel, const mesh::Mesh& mesh, const Fields& fields, int rule,
           const std::vector<Constants>& sets)
    : kernel_(std::move(kernel)),
      mesh_(&mesh),
      cell_calls_(select(kernel_.cells, rule)),
      facet_calls_(select(kernel_.facets, rule)),
      coordinates_(static_cast<std::size_t>(3 * mesh.vertices_per_cell)) {
    if (cell_calls_.empty() && facet_calls_.empty()) {
        throw std::logic_error("form " + kernel_.name + " has no rule " + std::to_string(rule));
    }
    for (const Constants& constants : sets) {
        const std::size_t first = constants_.size();
        for (const std::string& name : kernel_.constants) {
            const std::vector<double>& values = bound(constants, name, kernel_.name);
            constant_offsets_[name] = constants_.size() - first;
            constants_.insert(constants_.end(), values.begin(), values.end());
        }
        constants_size_ = constants_.size() - first;
    }
    std::size_t size = 0;
    for (const std::string& name : kernel_.coefficients) {
        fields_.push_back(bound(fields, name, kernel_.name));
        const Field& field = fields_.back();
        size += field.dofmap == nullptr
                    ? field.values->size()
                    : static_cast<std::size_t>(field.components * field.dofmap->nodes_per_cell);
    }
    coefficients_.resize(size);
}

void Form::gather(std::int32_t cell) {
    const auto vertices = static_cast<std::size_t>(mesh_->vertices_per_cell);
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto vertex = mesh_->cells[static_cast<std::size_t>(cell) * vertices + v];
        std::ranges::copy(mesh_->points[static_cast<std::size_t>(vertex)],
                          coordinates_.begin() + static_cast<long>(3 * v));
    }
    double* target = coefficients_.data();
    for (const Field& field : fields_) {
        if (field.dofmap == nullptr) {  // the values of the facet at hand, kept by the caller
            target = std::ranges::copy(*field.values, target).out;
            continue;
        }
        for (const std::int32_t node : field.dofmap->of(cell)) {
            const double* source = field.values->data() + static_cast<std::size_t>(node) *
                                                              static_cast<std::size_t>(field.components);
            for (int c = 0; c < field.components; ++c) {  // few: a call takes longer
                *target++ = source[c];
            }
        }
    }
}

const double* Form::constants_of(std::int32_t cell) const {
    if (constants_.size() == constants_size_) {
        return constants_.data();
    }
    const std::int32_t region = mesh_->cell_regions[static_cast<std::size_t>(cell)];
    const std::size_t sets = constants_.size() / constants_size_;
    return constants_.data() + (region < 0 ? sets - 1 : static_cast<std::size_t>(region)) * constants_size_;
}

void Form::add_cell(std::int32_t cell, std::span<double> tensor) {
    gather(cell);
    for (const Tabulate tabulate : cell_calls_) {
        tabulate(tensor.data(), coefficients_.data(), constants_of(cell), coordinates_.data(), nullptr,
                 nullptr);
    }
}

void Form::add_facet(const mesh::Facet& facet, std::span<double> tensor) {
    gather(facet.cell);
    tabulate(facet, coefficients_.data(), coordinates_.data(), tensor.data());
}

void Form::tabulate(const mesh::Facet& facet, const double* coefficients, const double* vertices,
                    double* tensor) const {
    const int local = facet.local;
    for (const Tabulate call : facet_calls_) {
        call(tensor, coefficients, constants_of(facet.cell), vertices, &local, nullptr);
    }
}

bool Form::set_constant(const std::string& name, double value) {
    bool changed = false;
    if (const auto offset = constant_offsets_.find(name); offset != constant_offsets_.end()) {
        for (std::size_t i = offset->second; i < constants_.size(); i += constants_size_) {
            changed = changed || constants_[i] != value;
            constants_[i] = value;
        }
    }
    return changed;
}

}  // namespace thermocontact::fem

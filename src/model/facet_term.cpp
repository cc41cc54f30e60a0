#include "model/facet_term.h"

#include <algorithm>

#include "fem/block_matrix.h"

namespace thermocontact::model {

FacetTerm::FacetTerm(const fem::Space& space, int components, std::vector<double>& unknown)
    : space_(&space), components_(components), unknown_(&unknown) {}

void FacetTerm::add(const std::string& law, const mesh::Mesh& mesh, const ContactSurface& surface,
                    const fem::Constants& constants, const fem::Fields& fields) {
    const auto form = [&](const std::string& name) {
        return std::make_unique<fem::Form>(fem::find_kernel(law + name, mesh.cell, space_->element.degree),
                                           mesh, constants, fields, surface.rule);
    };
    const bool rubs = law == "friction";
    laws_.push_back({law, &surface.facets, form(".residual"), form(".jacobian"),
                     rubs ? surface.laws.friction->regularisation : 0.0});
}

void FacetTerm::restrict_to(const std::vector<std::int32_t>& dofs) {
    dofs_ = dofs;
    index_.assign(unknown_->size(), -1);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        index_[static_cast<std::size_t>(dofs[i])] = static_cast<std::int32_t>(i);
    }
}

void FacetTerm::set_step(double k) {
    for (Law& law : laws_) {
        law.residual->set_constant("k", k);
        law.jacobian->set_constant("k", k);
    }
}

void FacetTerm::raise_regularisation(double floor) {
    for (Law& law : laws_) {
        if (law.regularisation > 0) {
            law.residual->set_constant("eps", std::max(floor, law.regularisation));
            law.jacobian->set_constant("eps", std::max(floor, law.regularisation));
        }
    }
}

double FacetTerm::smallest_regularisation() const {
    double smallest = 0;
    for (const Law& law : laws_) {
        if (law.regularisation > 0 && (smallest == 0 || law.regularisation < smallest)) {
            smallest = law.regularisation;
        }
    }
    return smallest;
}

void FacetTerm::scatter(const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
        (*unknown_)[static_cast<std::size_t>(dofs_[i])] = x[static_cast<Eigen::Index>(i)];
    }
}

void FacetTerm::unknowns_of(const mesh::Facet& facet) {
    local_.clear();
    for (const std::int32_t node : space_->dofmap.of(facet.cell)) {
        for (std::int32_t c = 0; c < components_; ++c) {
            const std::int32_t dof = node * components_ + c;
            local_.push_back(index_[static_cast<std::size_t>(dof)]);
        }
    }
}

void FacetTerm::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) {
    scatter(x);
    value.setZero(x.size());
    for (const Law& law : laws_) {
        for (const mesh::Facet& facet : *law.facets) {
            unknowns_of(facet);
            tensor_.assign(local_.size(), 0.0);
            law.residual->add_facet(facet, tensor_);
            for (std::size_t i = 0; i < local_.size(); ++i) {
                if (local_[i] >= 0) {
                    value[local_[i]] += tensor_[i];
                }
            }
        }
    }
}

void FacetTerm::visit_derivative(const Eigen::VectorXd& x, const Piece& visit) {
    scatter(x);
    for (const Law& law : laws_) {
        for (const mesh::Facet& facet : *law.facets) {
            unknowns_of(facet);
            tensor_.assign(local_.size() * local_.size(), 0.0);
            law.jacobian->add_facet(facet, tensor_);
            visit(local_, tensor_);
        }
    }
}

void FacetTerm::visit_derivative_of(std::size_t law, const Piece& visit) {
    std::vector<std::int32_t> dofs;
    for (const mesh::Facet& facet : *laws_[law].facets) {
        dofs.clear();
        for (const std::int32_t node : space_->dofmap.of(facet.cell)) {
            for (std::int32_t c = 0; c < components_; ++c) {
                dofs.push_back(node * components_ + c);
            }
        }
        tensor_.assign(dofs.size() * dofs.size(), 0.0);
        laws_[law].jacobian->add_facet(facet, tensor_);
        visit(dofs, tensor_);
    }
}

void FacetTerm::nodal_forces(std::string_view name, std::vector<double>& forces) {
    const auto d = static_cast<std::size_t>(components_);
    for (const Law& law : laws_) {
        for (const mesh::Facet& facet : *law.facets) {
            for (const std::int32_t node : space_->dofmap.of(facet.cell)) {
                std::fill_n(forces.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * d),
                            d, 0.0);
            }
        }
    }
    for (const Law& law : laws_) {
        if (law.name == name) {
            fem::assemble_facets(*law.residual, *law.facets, space_->dofmap, components_, forces);
        }
    }
}

}  // namespace thermocontact::model

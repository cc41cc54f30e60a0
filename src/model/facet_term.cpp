#include "model/facet_term.h"

#include <algorithm>
#include <cmath>

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
    const char* regularised_by = "";
    double regularisation = 0;
    if (law == "friction") {
        regularised_by = "eps";
        regularisation = surface.laws.friction->regularisation;
    } else if (law == "conductance" && std::isfinite(surface.laws.conductance->limit)) {
        regularised_by = "L";
        regularisation = surface.laws.conductance->limit;
    }
    const auto datum = fields.find(law == "compliance" ? "u_old" : law == "conductance" ? "theta_F" : "");
    laws_.push_back({law, &surface.facets, form(".residual"), form(".jacobian"), regularised_by,
                     regularisation, datum != fields.end() ? datum->second.values : nullptr});
}

void FacetTerm::restrict_to(const std::vector<std::int32_t>& dofs) {
    dofs_ = dofs;
    index_.assign(unknown_->size(), -1);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        index_[static_cast<std::size_t>(dofs[i])] = static_cast<std::int32_t>(i);
    }
}

void FacetTerm::set_step(double k) {
    step_ = k;
    for (Law& law : laws_) {
        law.residual->set_constant("k", k);
        law.jacobian->set_constant("k", k);
    }
}

void FacetTerm::raise_regularisation(double floor) {
    for (Law& law : laws_) {
        if (law.regularisation > 0) {
            law.residual->set_constant(law.regularised_by, std::max(floor, law.regularisation));
            law.jacobian->set_constant(law.regularised_by, std::max(floor, law.regularisation));
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

double FacetTerm::largest_foundation() const {
    double largest = 0;
    for (const Law& law : laws_) {
        if (law.name == "conductance" && law.datum != nullptr) {
            for (const double theta_F : *law.datum) {
                largest = std::max(largest, std::abs(theta_F));
            }
        }
    }
    return largest;
}

bool FacetTerm::has_friction() const {
    return std::ranges::any_of(laws_, [](const Law& law) { return law.name == "friction"; });
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

void FacetTerm::add_sensitivity(const Eigen::VectorXd& x, Eigen::VectorXd& noise) {
    scatter(x);
    for (std::size_t law = 0; law < laws_.size(); ++law) {
        if (laws_[law].datum == nullptr) {
            continue;
        }
        const double step = laws_[law].name == "compliance" ? step_ : 1.0;  // dF/dw is k dF/du
        visit_derivative_of(law, [&](std::span<const std::int32_t> dofs, std::span<const double> values) {
            for (std::size_t i = 0; i < dofs.size(); ++i) {
                const std::int32_t row = index_[static_cast<std::size_t>(dofs[i])];
                for (std::size_t j = 0; j < dofs.size() && row >= 0; ++j) {
                    const double datum = (*laws_[law].datum)[static_cast<std::size_t>(dofs[j])];
                    noise[row] += std::abs(values[i * dofs.size() + j] / step * datum);
                }
            }
        });
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

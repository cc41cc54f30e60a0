#include "model/facet_term.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/block_matrix.h"

namespace thermocontact::model {

FacetTerm::FacetTerm(const fem::Space& space, int components, std::vector<double>& unknown)
    : space_(&space), components_(components), unknown_(&unknown) {}

void FacetTerm::add(const std::string& law, const mesh::Mesh& mesh, const ContactSurface& surface,
                    const fem::Constants& constants, const fem::Fields& fields) {
    FrictionMultiplier* multiplier = law == "friction" ? surface.multiplier.get() : nullptr;
    const std::string file = multiplier != nullptr ? "coulomb" : law;
    fem::Fields taken = fields;
    if (multiplier != nullptr) {
        taken["lam"] = multiplier->on_facet();
    }
    if (law == "friction") {
        taken["v_F"] = surface.velocity_of_foundation(*space_, components_);
    }
    const auto form = [&](const std::string& name) {
        return fem::Form(
            fem::kernel_in_force(file + name, mesh.cell, space_->element.degree, surface.kernels), mesh,
            constants, taken, surface.rule);
    };
    auto nodes = std::make_unique<fem::FacetNodes>(*space_, surface.facets);
    const auto over_nodes = [&](const std::string& name) {
        return std::make_unique<fem::FacetForm>(form(name), *space_, mesh, *nodes, components_);
    };
    auto residual = over_nodes(".residual"), jacobian = over_nodes(".jacobian");
    std::string regularised_by, width_key = "regularisation";
    double regularisation = 0;
    if (law == "friction" && multiplier == nullptr) {
        regularised_by = "eps";
        regularisation = surface.laws.friction->regularisation;
    } else if (law == "conductance") {
        const scene::Law& of_law = surface.laws.conductance->law;
        if (!of_law.width.empty() && std::isfinite(of_law.constants.at(of_law.width))) {
            regularised_by = of_law.width;
            width_key = of_law.width_key;
            regularisation = of_law.constants.at(of_law.width);
        }
    }
    const bool moves = !surface.laws.foundation_velocity.empty();
    const auto datum = fields.find(law == "compliance" ? "u_old" : law == "conductance" ? "theta_F" : "");
    laws_.push_back({law, std::move(nodes), std::move(residual), std::move(jacobian), multiplier, nullptr,
                     nullptr, std::move(regularised_by), std::move(width_key), regularisation,
                     datum != fields.end() ? datum->second.values : nullptr,
                     law == "friction" && moves ? &surface.foundation_velocity : nullptr});
    for (std::size_t facet = 0; facet < surface.facets.size(); ++facet) {
        for (const std::int32_t node : laws_.back().nodes->of(facet)) {
            for (std::int32_t c = 0; c < components_; ++c) {
                laws_.back().dofs.push_back(node * components_ + c);
            }
        }
    }
    if (multiplier != nullptr) {
        laws_.back().functional = std::make_unique<fem::Form>(form(".functional"));
        laws_.back().node_area = std::make_unique<fem::Form>(
            fem::find_kernel("kinematics.node_area", mesh.cell, space_->element.degree), mesh, constants);
    }
}

void FacetTerm::restrict_to(const std::vector<std::int32_t>& dofs) {
    dofs_ = dofs;
    index_.assign(unknown_->size(), -1);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        index_[static_cast<std::size_t>(dofs[i])] = static_cast<std::int32_t>(i);
    }
    for (Law& law : laws_) {
        law.unknowns.resize(law.dofs.size());
        std::ranges::transform(law.dofs, law.unknowns.begin(),
                               [this](std::int32_t dof) { return index_[static_cast<std::size_t>(dof)]; });
    }
}

void FacetTerm::set_step(double k) {
    step_ = k;
    for (Law& law : laws_) {
        law.residual->set_constant("k", k);
        law.jacobian->set_constant("k", k);
        if (law.functional) {
            law.functional->set_constant("k", k);
        }
    }
}

bool FacetTerm::has_exact_friction() const {
    return std::ranges::any_of(laws_, [](const Law& law) { return law.multiplier != nullptr; });
}

double FacetTerm::stiffness_against_slip(const fem::BlockMatrix& matrix) const {
    std::vector<double> areas(space_->nodes.size(), 0.0);
    for (const Law& law : laws_) {
        if (law.multiplier != nullptr) {
            fem::assemble_facets(*law.node_area, law.facets(), space_->dofmap, 1, areas);
        }
    }
    double largest = 0;
    const auto c = static_cast<std::size_t>(components_);
    for (std::size_t node = 0; node < areas.size(); ++node) {
        for (std::size_t i = 0; i < c && areas[node] > 0; ++i) {
            const auto block = static_cast<std::size_t>(matrix.graph->offsets[node]);  // the diagonal one
            largest = std::max(largest, matrix.values[(block * c + i) * c + i] / areas[node]);
        }
    }
    return largest;
}

void FacetTerm::set_slip_stiffness(double gamma) {
    slip_stiffness_ = gamma;
    for (Law& law : laws_) {
        if (law.multiplier != nullptr) {
            law.multiplier->slip_stiffness = gamma;
            law.residual->set_constant("gamma", gamma);
            law.jacobian->set_constant("gamma", gamma);
            law.functional->set_constant("gamma", gamma);
        }
    }
}

void FacetTerm::set_width_of_exact_friction(double width) {
    for (Law& law : laws_) {
        if (law.multiplier != nullptr) {
            law.regularisation = width;
        }
    }
}

FacetTerm::MultiplierChange FacetTerm::update_multipliers() {
    MultiplierChange result;
    for (const Law& law : laws_) {
        if (law.multiplier == nullptr) {
            continue;
        }
        const std::vector<double> before = law.multiplier->values();
        tensor_.resize(law.multiplier->functional_size());
        for_facets(law, [&](std::size_t number) {
            std::ranges::fill(tensor_, 0.0);
            law.functional->add_facet(law.facets()[number], tensor_);
            law.multiplier->take(number, tensor_);
        });
        const std::vector<double>& now = law.multiplier->values();
        for (std::size_t i = 0; i < now.size(); ++i) {
            result.change += (now[i] - before[i]) * (now[i] - before[i]);
            result.size += now[i] * now[i];
        }
        const double rounded = std::numeric_limits<double>::epsilon() / 2 * slip_stiffness_;
        result.rounding += static_cast<double>(now.size()) * rounded * rounded;
    }
    return result;
}

void FacetTerm::raise_regularisation(double floor) {
    for (Law& law : laws_) {
        if (law.multiplier != nullptr) {
            const double sharpness = floor > law.regularisation ? law.regularisation / floor : 1.0;
            law.residual->set_constant("gamma", sharpness * slip_stiffness_);
            law.jacobian->set_constant("gamma", sharpness * slip_stiffness_);
        } else if (law.regularisation > 0) {
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

std::string FacetTerm::regularisation_key() const {
    const auto law = std::ranges::find_if(laws_, [](const Law& some) { return some.regularisation > 0; });
    return law == laws_.end() ? "" : law->name + "." + law->width_key;
}

double FacetTerm::largest_foundation() const {
    double largest = 0;
    for (const Law& law : laws_) {
        const std::vector<double>* foundation =
            law.name == "conductance" ? law.datum : law.foundation_velocity;
        if (foundation != nullptr) {
            for (const double value : *foundation) {
                largest = std::max(largest, std::abs(value));
            }
        }
    }
    return largest;
}

bool FacetTerm::has_friction() const {
    return std::ranges::any_of(laws_, [](const Law& law) { return law.name == "friction"; });
}

template <typename Visit>
void FacetTerm::for_facets(const Law& law, Visit&& visit) {
    for (std::size_t i = 0; i < law.facets().size(); ++i) {
        if (law.multiplier != nullptr) {
            law.multiplier->show(i);
        }
        visit(i);
    }
}

void FacetTerm::scatter(const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
        (*unknown_)[static_cast<std::size_t>(dofs_[i])] = x[static_cast<Eigen::Index>(i)];
    }
}

void FacetTerm::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) {
    scatter(x);
    value.setZero(x.size());
    for (const Law& law : laws_) {
        for_facets(law, [&](std::size_t facet) {
            const std::span<const double> tensor = law.residual->tensor(facet);
            const std::span<const std::int32_t> unknowns = law.of_facet(law.unknowns, facet);
            for (std::size_t i = 0; i < tensor.size(); ++i) {
                if (unknowns[i] >= 0) {
                    value[unknowns[i]] += tensor[i];
                }
            }
        });
    }
}

void FacetTerm::visit_derivative(const Eigen::VectorXd& x, const Piece& visit) {
    scatter(x);
    for (const Law& law : laws_) {
        for_facets(law, [&](std::size_t facet) {
            visit(law.of_facet(law.unknowns, facet), law.jacobian->tensor(facet));
        });
    }
}

void FacetTerm::add_sensitivity(const Eigen::VectorXd& x, Eigen::VectorXd& noise) {
    scatter(x);
    for (std::size_t law = 0; law < laws_.size(); ++law) {
        add_sensitivity_of(law, noise);
    }
}

void FacetTerm::add_sensitivity_of(std::size_t law, Eigen::VectorXd& noise) {
    if (laws_[law].datum != nullptr) {
        const double step = laws_[law].name == "compliance" ? step_ : 1.0;  // dF/dw is k dF/du
        add_product_of_magnitudes(law, 1 / step, *laws_[law].datum, noise);
    }
}

/// |factor dF/dx| |values| of one law.
void FacetTerm::add_product_of_magnitudes(std::size_t law, double factor, const std::vector<double>& values,
                                          Eigen::VectorXd& sum) {
    visit_derivative_of(law, [&](std::span<const std::int32_t> dofs, std::span<const double> derivative) {
        for (std::size_t i = 0; i < dofs.size(); ++i) {
            const std::int32_t row = index_[static_cast<std::size_t>(dofs[i])];
            for (std::size_t j = 0; j < dofs.size() && row >= 0; ++j) {
                const double value = values[static_cast<std::size_t>(dofs[j])];
                sum[row] += std::abs(factor * derivative[i * dofs.size() + j] * value);
            }
        }
    });
}

std::vector<double> FacetTerm::magnitudes(const Eigen::VectorXd& x) {
    scatter(x);
    std::vector<double> result;
    for (std::size_t law = 0; law < laws_.size(); ++law) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
        add_product_of_magnitudes(law, 1, *unknown_, sum);
        add_sensitivity_of(law, sum);
        result.push_back(sum.lpNorm<1>());
    }
    return result;
}

/// Whether the compliance of the surface that exact friction acts on has a derivative on the facet.
bool FacetTerm::presses(std::size_t facet, std::size_t friction) {
    const auto compliance = std::ranges::find_if(laws_, [&](const Law& law) {
        return law.name == "compliance" && &law.facets() == &laws_[friction].facets();
    });
    return compliance == laws_.end() ||
           std::ranges::any_of(compliance->jacobian->tensor(facet), [](double entry) { return entry != 0; });
}

void FacetTerm::visit_derivative_of(std::size_t law, const Piece& visit) {
    for_facets(laws_[law], [&](std::size_t facet) {
        if (laws_[law].multiplier == nullptr || presses(facet, law)) {
            visit(laws_[law].of_facet(laws_[law].dofs, facet), laws_[law].jacobian->tensor(facet));
        }
    });
}

void FacetTerm::nodal_forces(std::string_view name, std::vector<double>& forces) {
    for (const Law& law : laws_) {
        for (const std::int32_t dof : law.dofs) {
            forces[static_cast<std::size_t>(dof)] = 0;
        }
    }
    for (const Law& law : laws_) {
        if (law.name != name) {
            continue;
        }
        for_facets(law, [&](std::size_t facet) {
            const std::span<const double> tensor = law.residual->tensor(facet);
            const std::span<const std::int32_t> dofs = law.of_facet(law.dofs, facet);
            for (std::size_t i = 0; i < tensor.size(); ++i) {
                forces[static_cast<std::size_t>(dofs[i])] += tensor[i];
            }
        });
    }
}

std::vector<std::int32_t> FacetTerm::nodes_with_forces() const {
    std::vector<std::int32_t> nodes;
    for (const Law& law : laws_) {
        for (std::size_t facet = 0; facet < law.facets().size(); ++facet) {
            const auto of_facet = law.nodes->of(facet);
            nodes.insert(nodes.end(), of_facet.begin(), of_facet.end());
        }
    }
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

double FacetTerm::power_of_foundations() {
    double power = 0;
    for (const Law& law : laws_) {
        if (law.foundation_velocity == nullptr) {
            continue;
        }
        for_facets(law, [&](std::size_t facet) {
            const std::span<const double> tensor = law.residual->tensor(facet);  // -sigma_t
            const std::span<const std::int32_t> dofs = law.of_facet(law.dofs, facet);
            for (std::size_t i = 0; i < tensor.size(); ++i) {
                power -= tensor[i] * (*law.foundation_velocity)[static_cast<std::size_t>(dofs[i])];
            }
        });
    }
    return power;
}

}  // namespace thermocontact::model

#include "model/springs.h"

#include <algorithm>

#include "model/loads.h"

namespace thermocontact::model {

Springs::Springs(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space)
    : mesh_(&mesh), space_(&space), dimension_(scene.dimension) {
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.spring) {
            Side side{};
            side.spring = &*boundary.spring;
            side.facets = facets_of(mesh, name);
            for (const mesh::Facet& facet : side.facets) {
                std::ranges::copy(space.facet_nodes(facet), std::back_inserter(side.nodes));
            }
            std::ranges::sort(side.nodes);
            const auto repeated = std::ranges::unique(side.nodes);
            side.nodes.erase(repeated.begin(), repeated.end());
            assemble(side);
            sides_.push_back(std::move(side));
        }
    }
}

fem::Form Springs::form_of(const Side& side, double factor) const {
    std::vector<double> stiffness = side.spring->stiffness.matrix;
    std::ranges::for_each(stiffness, [&](double& entry) { entry *= factor; });
    return {fem::find_kernel("spring.stiffness", mesh_->cell, space_->element.degree),
            *mesh_,
            {{"k_s", stiffness}}};
}

void Springs::visit_stiffness(const Piece& visit) const {
    const auto d = static_cast<std::size_t>(dimension_);
    const std::size_t size = static_cast<std::size_t>(space_->dofmap.nodes_per_cell) * d;
    std::vector<std::int32_t> dofs(size);
    std::vector<double> tensor(size * size);
    for (const Side& side : sides_) {
        fem::Form form = form_of(side, 1.0);
        for (const mesh::Facet& facet : side.facets) {
            const auto nodes = space_->dofmap.of(facet.cell);
            for (std::size_t i = 0; i < size; ++i) {
                dofs[i] = nodes[i / d] * dimension_ + static_cast<std::int32_t>(i % d);
            }
            std::ranges::fill(tensor, 0.0);
            form.add_facet(facet, tensor);
            visit(dofs, tensor);
        }
    }
}

/// The side's own nodes only: off them the shape functions vanish on the facets.
void Springs::assemble(Side& side) const {
    const auto d = static_cast<std::size_t>(dimension_);
    const auto count = static_cast<Eigen::Index>(side.nodes.size() * d);
    const std::size_t size = static_cast<std::size_t>(space_->dofmap.nodes_per_cell) * d;
    std::vector<double> tensor(size * size);
    std::vector<Eigen::Index> index(size);
    std::vector<Eigen::Triplet<double>> entries;
    fem::Form form = form_of(side, 1.0);
    for (const mesh::Facet& facet : side.facets) {
        const auto nodes = space_->dofmap.of(facet.cell);
        for (std::size_t i = 0; i < size; ++i) {
            const auto found = std::ranges::lower_bound(side.nodes, nodes[i / d]);
            const bool here = found != side.nodes.end() && *found == nodes[i / d];
            index[i] =
                here ? (found - side.nodes.begin()) * dimension_ + static_cast<Eigen::Index>(i % d) : -1;
        }
        std::ranges::fill(tensor, 0.0);
        form.add_facet(facet, tensor);
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t j = 0; j < size; ++j) {
                if (index[i] >= 0 && index[j] >= 0 && tensor[i * size + j] != 0) {
                    entries.emplace_back(index[i], index[j], tensor[i * size + j]);
                }
            }
        }
    }
    side.stiffness.resize(count, count);
    side.stiffness.setFromTriplets(entries.begin(), entries.end());
}

void Springs::add_to(double factor, fem::BlockMatrix& matrix) const {
    for (const Side& side : sides_) {
        fem::Form form = form_of(side, factor);
        fem::assemble_facets(form, side.facets, *space_, matrix);
    }
}

Eigen::VectorXd Springs::anchor(const Side& side, double t) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(side.nodes.size()) * dimension_);
    const std::vector<scene::Expression>& anchor = side.spring->anchor;
    Eigen::Index i = 0;
    for (const std::int32_t node : side.nodes) {
        for (std::size_t c = 0; c < anchor.size(); ++c) {
            values[i++] = anchor[c](space_->nodes[static_cast<std::size_t>(node)], t);
        }
    }
    return values;
}

void Springs::move(double begin, double stage, double end) {
    for (Side& side : sides_) {
        side.begin = anchor(side, begin);
        side.stage = anchor(side, stage);
        side.end = stage == end ? side.stage : anchor(side, end);
    }
}

template <typename Use>
void Springs::for_dofs(const Side& side, Use&& use) const {
    Eigen::Index i = 0;
    for (const std::int32_t node : side.nodes) {
        for (int c = 0; c < dimension_; ++c) {
            use(static_cast<std::size_t>(node * dimension_ + c), i++);
        }
    }
}

Eigen::VectorXd Springs::at(const Side& side, const std::vector<double>& field) const {
    Eigen::VectorXd values(side.stiffness.rows());
    for_dofs(side, [&](std::size_t dof, Eigen::Index i) { values[i] = field[dof]; });
    return values;
}

void Springs::add_forces(double factor, const std::vector<double>& u, std::vector<double>& forces) const {
    for (const Side& side : sides_) {
        const Eigen::VectorXd force = side.stiffness * (at(side, u) - side.stage);
        for_dofs(side, [&](std::size_t dof, Eigen::Index i) { forces[dof] += factor * force[i]; });
    }
}

Springs::Work Springs::work(const Motion& motion) const {
    Work sum;
    for (const Side& side : sides_) {
        const Eigen::VectorXd old = at(side, motion.begin) - side.begin,
                              now = at(side, motion.end) - side.end,
                              stage = at(side, motion.stage) - side.stage, anchors = side.end - side.begin,
                              force = side.stiffness * stage;
        Eigen::VectorXd change(old.size()), reach(old.size());
        for_dofs(side, [&](std::size_t dof, Eigen::Index i) {
            change[i] = motion.change(dof);
            reach[i] = motion.reach(dof);
        });
        sum.old += old.dot(side.stiffness * old) / 2;
        sum.now += now.dot(side.stiffness * now) / 2;
        sum.numerical +=
            (stage - (old + now) / 2).dot(side.stiffness * (change - anchors)) + force.dot(reach - change);
        sum.of_anchors -= force.dot(anchors);
    }
    return sum;
}

Springs::Parts Springs::parts(const std::vector<double>& u) const {
    Parts sum;
    for (const Side& side : sides_) {
        const Eigen::VectorXd here = at(side, u), force = side.stiffness * here;
        sum.force += force.lpNorm<1>();
        sum.energy += here.cwiseAbs().dot(force.cwiseAbs());
    }
    return sum;
}

double Springs::energy(const std::vector<double>& u, double t) const {
    double sum = 0;
    for (const Side& side : sides_) {
        const Eigen::VectorXd length = at(side, u) - anchor(side, t);
        sum += length.dot(side.stiffness * length) / 2;
    }
    return sum;
}

}  // namespace thermocontact::model

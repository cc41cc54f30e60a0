#include "model/nodal.h"

#include <algorithm>

namespace thermocontact::model {

void interpolate_at(const fem::Space& space, std::span<const scene::Expression> expressions,
                    std::span<const std::int32_t> nodes, double t, std::vector<double>& values) {
    for (const std::int32_t node : nodes) {
        const auto n = static_cast<std::size_t>(node);
        for (std::size_t c = 0; c < expressions.size(); ++c) {
            values[n * expressions.size() + c] = expressions[c](space.nodes[n], t);
        }
    }
}

std::vector<double> interpolate(const fem::Space& space, std::span<const scene::Expression> expressions,
                                int components, double t) {
    std::vector<double> values(space.nodes.size() * static_cast<std::size_t>(components), 0.0);
    for (std::size_t n = 0; n < space.nodes.size(); ++n) {
        for (std::size_t c = 0; c < expressions.size(); ++c) {
            values[n * expressions.size() + c] = expressions[c](space.nodes[n], t);
        }
    }
    return values;
}

bool depends_on_time(std::span<const scene::Expression> expressions) {
    return std::ranges::any_of(expressions, &scene::Expression::depends_on_time);
}

Prescribed Prescribed::displacement(const scene::Scene& scene, const mesh::Mesh& mesh,
                                    const fem::Space& space) {
    Prescribed result(space.nodes.size() * static_cast<std::size_t>(scene.dimension));
    for (const auto& [name, boundary] : scene.boundaries) {
        for (std::size_t c = 0; c < boundary.displacement.size(); ++c) {
            if (boundary.displacement[c]) {
                result.add(mesh, space, name, scene.dimension, static_cast<int>(c),
                           *boundary.displacement[c]);
            }
        }
    }
    result.finish();
    return result;
}

Prescribed Prescribed::temperature(const scene::Scene& scene, const mesh::Mesh& mesh,
                                   const fem::Space& space) {
    Prescribed result(space.nodes.size());
    for (const auto& [name, boundary] : scene.boundaries) {
        if (boundary.temperature) {
            result.add(mesh, space, name, 1, 0, *boundary.temperature);
        }
    }
    result.finish();
    return result;
}

void Prescribed::add(const mesh::Mesh& mesh, const fem::Space& space, const std::string& boundary,
                     int components, int component, const scene::Expression& expression) {
    const auto index = std::ranges::find(mesh.boundary_names, boundary) - mesh.boundary_names.begin();
    for (const std::int32_t node : space.boundary_nodes[static_cast<std::size_t>(index)]) {
        values_.push_back(
            {node * components + component, space.nodes[static_cast<std::size_t>(node)], expression});
        fixed_[static_cast<std::size_t>(values_.back().dof)] = 1;
    }
}

void Prescribed::finish() {
    for (std::size_t dof = 0; dof < fixed_.size(); ++dof) {
        if (fixed_[dof] != 0) {
            dofs_.push_back(static_cast<std::int32_t>(dof));
        }
    }
}

void Prescribed::apply(double t, std::vector<double>& values) const {
    for (const Value& value : values_) {
        values[static_cast<std::size_t>(value.dof)] = value.expression(value.x, t);
    }
}

}  // namespace thermocontact::model

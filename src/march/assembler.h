/// Operators of the body by the name of their form.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "fem/block_matrix.h"
#include "march/vectors.h"
#include "model/physics.h"

namespace thermocontact::march {

struct Assembler {
    const scene::Scene& scene;
    const mesh::Mesh& mesh;
    const fem::Space& space;
    const fem::NodeGraph& graph;

    fem::BlockMatrix operator()(const std::string& form, int rows, int columns) const {
        auto kernel = fem::kernel_in_force(form, mesh.cell, space.element.degree, scene.kernels);
        return fem::assemble_matrix(
            fem::Form::by_region(std::move(kernel), mesh, model::body_constants(scene, mesh)), space, graph,
            rows, columns);
    }

    /// Nothing for physics that is absent.
    std::optional<fem::BlockMatrix> when(bool present, const std::string& form, int rows, int columns) const {
        return present ? std::optional((*this)(form, rows, columns)) : std::nullopt;
    }
};

/// For fem::Product.
inline const fem::BlockMatrix* pointer(const std::optional<fem::BlockMatrix>& matrix) {
    return matrix ? &*matrix : nullptr;
}

}  // namespace thermocontact::march

/// Operators of the body by the name of their form.
#pragma once

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
        auto kernel = fem::find_kernel(form, mesh.cell, space.element.degree);
        return fem::assemble_matrix({std::move(kernel), mesh, model::body_constants(scene)}, space, graph, rows, columns);
    }

    /// Nothing for physics that is absent.
    std::optional<fem::BlockMatrix> when(bool present, const std::string& form, int rows, int columns) const {
        return present ? std::optional((*this)(form, rows, columns)) : std::nullopt;
    }
};

/// matrix * x, or zeros [size] for an operator that is absent.
inline std::vector<double> product(const std::optional<fem::BlockMatrix>& matrix, const std::vector<double>& x,
                                   std::size_t size) {
    return matrix ? matrix->multiply(x) : std::vector<double>(size, 0.0);
}

}  // namespace thermocontact::march

/// Operators of the body by the name of their form.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fem/block_matrix.h"
#include "fem/throwing_tasks.h"
#include "march/vectors.h"
#include "model/physics.h"
#include "solve/step_problem.h"

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

    /// To be done later (assemble_beside); nothing for physics that is absent.
    template <typename Present>
    std::function<void()> into(std::optional<fem::BlockMatrix>& place, const Present& present,
                               const char* form, int rows, int columns) const {
        const bool wanted = static_cast<bool>(present);
        return [this, &place, wanted, form, rows, columns] {
            if (wanted) {
                place = (*this)(form, rows, columns);
            }
        };
    }
};

/// Runs the assemblies, each into a place of its own, beside each other where the strategy has threads.
inline void assemble_beside(const solve::Strategy& strategy,
                            const std::vector<std::function<void()>>& assemblies) {
    fem::run_throwing([&](int count, const std::function<void(int)>& task) { strategy.beside(count, task); },
                      static_cast<int>(assemblies.size()),
                      [&](int number) { assemblies[static_cast<std::size_t>(number)](); });
}

/// For fem::Product.
inline const fem::BlockMatrix* pointer(const std::optional<fem::BlockMatrix>& matrix) {
    return matrix ? &*matrix : nullptr;
}

}  // namespace thermocontact::march

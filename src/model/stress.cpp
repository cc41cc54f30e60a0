#include "model/stress.h"

#include <algorithm>

#include "fem/block_matrix.h"
#include "model/physics.h"

namespace thermocontact::model {

StressProbe::StressProbe(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                         const std::vector<double>& displacement, const std::vector<double>& velocity,
                         const std::vector<double>& temperature)
    : cell_count_(mesh.cell_count()) {
    const auto cells = static_cast<std::size_t>(cell_count_);
    stress_.resize(6 * cells);
    volumes_.assign(cells, 0.0);
    if (!scene.heat) {
        no_temperature_.assign(space.nodes.size(), 0.0);
    }
    const fem::Fields fields{{"u", {&displacement, scene.dimension, &space.dofmap}},
                             {"w", {&velocity, scene.dimension, &space.dofmap}},
                             {"theta", {scene.heat ? &temperature : &no_temperature_, 1, &space.dofmap}},
                             {"s", {&stress_, 6, &space.cellwise}}};
    const auto form = [&](const char* name) {
        auto kernel = fem::kernel_in_force(name, mesh.cell, scene.degree, scene.kernels);
        return std::make_unique<fem::Form>(
            fem::Form::by_region(std::move(kernel), mesh, body_constants(scene, mesh), fields));
    };
    integrated_ = form("stress.integrated");
    von_mises_ = form("stress.von_mises");
    const auto volume = form("stress.volume");
    for (std::int32_t cell = 0; cell < cell_count_; ++cell) {
        volume->add_cell(cell, {&volumes_[static_cast<std::size_t>(cell)], 1});
    }
}

const std::vector<double>& StressProbe::mean_stress() {
    for (std::size_t cell = 0; cell < volumes_.size(); ++cell) {
        const std::span<double> tensor(&stress_[6 * cell], 6);
        std::ranges::fill(tensor, 0.0);
        integrated_->add_cell(static_cast<std::int32_t>(cell), tensor);
        for (double& component : tensor) {
            component /= volumes_[cell];
        }
    }
    return stress_;
}

std::vector<double> StressProbe::von_mises() {
    mean_stress();
    std::vector<double> result(volumes_.size(), 0.0);
    for (std::size_t cell = 0; cell < volumes_.size(); ++cell) {
        von_mises_->add_cell(static_cast<std::int32_t>(cell), {&result[cell], 1});
        result[cell] /= volumes_[cell];
    }
    return result;
}

}  // namespace thermocontact::model

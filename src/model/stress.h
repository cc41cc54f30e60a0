/// Stress of a state, cell by cell.
#pragma once

#include <memory>
#include <vector>

#include "fem/form.h"
#include "scene/scene.h"

namespace thermocontact::model {

class StressProbe {
  public:
    /// Absent fields of the scene count as zero.
    StressProbe(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                const std::vector<double>& displacement, const std::vector<double>& velocity,
                const std::vector<double>& temperature);

    /// Mean of sigma over each cell, Pa: [cells][6], components xx, yy, zz, xy, yz, xz.
    const std::vector<double>& mean_stress();

    /// Von Mises stress of the mean stress, Pa: [cells].
    std::vector<double> von_mises();

  private:
    std::int32_t cell_count_;
    std::vector<double> no_temperature_;
    std::vector<double> stress_;
    std::vector<double> volumes_;
    std::unique_ptr<fem::Form> integrated_, von_mises_;
};

}  // namespace thermocontact::model

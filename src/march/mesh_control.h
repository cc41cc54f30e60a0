/// When a mesh that adapts is changed, and to what, from estimates of the error in space.
///
///   too coarse   an estimate beyond mesh.refinement.tolerance: the step is repeated on a mesh that is aimed
///                at `safety` of it by equal shares of all cells (mesh/equidistribution.h), a few times
///   wasteful     a mesh for the same aim has less than `worth_joining` of the cells: the next step is begun
///                on that
///
/// A mesh is always derived from the base (mesh/forest.h), so that cells are joined by not being bisected.
#pragma once

#include <optional>

#include "fem/nested_transfer.h"
#include "march/state.h"
#include "model/error_in_space.h"
#include "scene/scene.h"

namespace thermocontact::march {

class MeshControl {
  public:
    static constexpr int most_tries = 12;  ///< of a step, on one mesh after another

    explicit MeshControl(const scene::Scene& scene) : scene_(&scene), spec_(*scene.mesh.refinement) {}

    /// The estimate for a state, and what it comes to.
    struct Verdict {
        model::ErrorInSpace estimate;
        double deformation_energy = 0, heat_energy = 0;  ///< largest norms so far
        double error = 0;                                ///< the larger of both errors, relative to these
    };

    /// Of a state of the whole mesh.
    Verdict judge(const fem::ForestSpace& on, const State& whole) const;

    bool is_too_coarse(const Verdict& verdict) const { return verdict.error > spec_.tolerance; }

    /// Whether the step after `step` is looked at.
    bool is_due(int step) const { return step % spec_.every == 0; }

    /// Another mesh with less error and at most max_cells; nothing where the limits allow none.
    std::optional<mesh::Forest> finer(const fem::ForestSpace& on, const Verdict& verdict) const;

    /// A mesh with fewer cells that does, if it is worth it.
    std::optional<mesh::Forest> coarser(const fem::ForestSpace& on, const Verdict& verdict) const;

    /// Takes the limit for what the mesh has now, as more cannot be solved.
    void limit_to(int cells) { spec_.max_cells = cells; }

  private:
    mesh::Forest aimed_at(double tolerance, const fem::ForestSpace& on, const Verdict& verdict) const;
    mesh::Forest within_limits(double tolerance, const fem::ForestSpace& on, const Verdict& verdict) const;

    const scene::Scene* scene_;
    scene::Refinement spec_;
};

}  // namespace thermocontact::march

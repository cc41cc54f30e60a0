/// A scene marched through time on a mesh that follows the solution (mesh_control.h), where the scene asks
/// for that; else on its own.
///
/// A step that is looked at begins with the state on the mesh of the step before. Where that has become
/// wasteful, or the step's solution errs too much, a simulation on another mesh takes over: the nodal fields,
/// rates of the scheme among them, are carried over from the state before the step, exactly where the mesh is
/// finer (fem/nested_transfer.h), and the step is solved there. What a coarser mesh cannot hold, and what
/// prescribed values at new nodes change, are terms of the history: *_of_remeshing. The initial state is
/// evaluated anew on each mesh.
///
/// The multipliers of exact friction begin a step at zero on a new mesh: they belong to facets, and a step's
/// iteration begins with them but does not depend on where it begins.
///
/// Every process estimates and makes the whole mesh from the whole state, so that all agree to the last bit.
#pragma once

#include <memory>
#include <optional>

#include "march/mesh_control.h"
#include "march/simulation.h"

namespace thermocontact::march {

class AdaptiveMarch {
  public:
    /// As Simulation, whose state is that of `earlier` where it is given. Throws what that does, and
    /// SceneError where the bisections of `earlier` are those of another mesh.
    explicit AdaptiveMarch(const scene::Scene& scene, const model::Sources& sources = {},
                           const parallel::Backend* backend = nullptr, const Snapshot* earlier = nullptr);

    /// Another one after advance() where the mesh has changed.
    Simulation& simulation() { return *simulation_; }

    /// Of the meshes so far: 0, 1, ...
    int mesh_number() const { return mesh_number_; }

    /// One step of the scene, as Simulation::advance(): where it throws, state and mesh are those before.
    void advance();

  private:
    struct Before {
        Snapshot snapshot;
        std::shared_ptr<const fem::ForestSpace> on;
        Simulation::Stored stored;
    };
    struct Known {
        int step;
        MeshControl::Verdict verdict;
    };

    void advance_looking(const Before& before);
    bool change_to(mesh::Forest forest, const Before& before);
    void put_back(const Before& before, const Simulation::Legacy& legacy);
    Snapshot carried(const Before& before, const fem::ForestSpace& to, const Simulation& fresh) const;
    void annotate(int looks);

    const scene::Scene* scene_;
    model::Sources sources_;
    const parallel::Backend* backend_;
    std::optional<MeshControl> control_;
    std::shared_ptr<const fem::ForestSpace> on_;
    std::unique_ptr<Simulation> simulation_;
    int mesh_number_ = 0;
    Simulation::Stored jump_;     ///< of what is stored, at the begin of the step
    std::optional<Known> known_;  ///< of a state on this mesh
};

}  // namespace thermocontact::march

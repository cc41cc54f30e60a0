/// The state of a simulation as grids: the body, and the facets in contact.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "march/simulation.h"
#include "model/stress.h"
#include "output/vtu.h"

namespace thermocontact::output {

class FieldGrids {
  public:
    /// Those of `names` (output.fields) that the scene has. The simulation must outlive this.
    FieldGrids(const scene::Scene& scene, march::Simulation& simulation);

    bool has_contact() const { return has_contact_; }

    VtuGrid body();
    VtuGrid contact();

  private:
    bool wants(const std::string& name) const { return names_.contains(name); }
    VtuGrid body_cells() const;
    VtuGrid contact_cells() const;
    void add_surface(std::size_t index, VtuGrid& grid, std::size_t first, std::size_t count);

    const scene::Scene* scene_;
    march::Simulation* simulation_;
    std::set<std::string> names_;
    bool has_contact_;
    std::optional<model::StressProbe> stress_;
};

/// Vectors [n][dimension] as VTK wants them, [n][3].
std::vector<double> three_components(const std::vector<double>& values, int dimension);

}  // namespace thermocontact::output

/// Expressions of a scene as values at the nodes of the space.
#pragma once

#include <span>
#include <vector>

#include "fem/space.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// Values [nodes][components] of the expressions at time t; zero where `expressions` is empty.
std::vector<double> interpolate(const fem::Space& space, std::span<const scene::Expression> expressions,
                                int components, double t);

/// The same at the listed nodes only, into `values`.
void interpolate_at(const fem::Space& space, std::span<const scene::Expression> expressions,
                    std::span<const std::int32_t> nodes, double t, std::vector<double>& values);

bool depends_on_time(std::span<const scene::Expression> expressions);

/// Prescribed values of the unknowns on boundaries.
class Prescribed {
  public:
    /// Displacement components of all boundaries that prescribe them.
    static Prescribed displacement(const scene::Scene& scene, const mesh::Mesh& mesh,
                                   const fem::Space& space);

    /// Temperature of all boundaries that prescribe it.
    static Prescribed temperature(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);

    /// [dofs]: 1 where a value is prescribed.
    const std::vector<char>& fixed() const { return fixed_; }

    /// Writes the values at time t into `values` [dofs]. Boundaries apply in order of their names; the later
    /// one has the shared nodes.
    void apply(double t, std::vector<double>& values) const;

    /// The prescribed dofs, each once.
    const std::vector<std::int32_t>& dofs() const { return dofs_; }

  private:
    struct Value {
        std::int32_t dof;
        mesh::Point x;
        scene::Expression expression;
    };

    Prescribed(std::size_t dof_count) : fixed_(dof_count, 0) {}
    void add(const mesh::Mesh& mesh, const fem::Space& space, const std::string& boundary, int components,
             int component, const scene::Expression& expression);
    void finish();

    std::vector<char> fixed_;
    std::vector<Value> values_;
    std::vector<std::int32_t> dofs_;
};

}  // namespace thermocontact::model

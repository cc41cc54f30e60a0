/// Right-hand sides that a scene prescribes: body force and traction, heat source and flux.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "fem/block_matrix.h"
#include "fem/form.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// A sum of assembled linear forms, each with its expressions; those without t are assembled once.
class Loads {
  public:
    static Loads mechanical(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);
    static Loads thermal(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);

    /// The load vector [nodes][components] at time t (s).
    const std::vector<double>& at(double t);

  private:
    struct Term {
        std::vector<scene::Expression> expressions;
        std::vector<double> nodal;  ///< interpolated expressions
        std::vector<std::int32_t> nodes;
        std::vector<mesh::Facet> facets;  ///< empty: over the cells
        std::unique_ptr<fem::Form> form;
    };

    Loads(const mesh::Mesh& mesh, const fem::Space& space, int components);
    void add(const std::string& kernel, const std::string& coefficient,
             std::vector<scene::Expression> expressions, std::vector<mesh::Facet> facets);
    void assemble(Term& term, double t, std::vector<double>& vector);

    const mesh::Mesh* mesh_;
    const fem::Space* space_;
    int components_;
    std::vector<std::unique_ptr<Term>> varying_;
    std::vector<double> constant_;
    std::vector<double> sum_;
};

/// The facets of the boundary of that name.
std::vector<mesh::Facet> facets_of(const mesh::Mesh& mesh, const std::string& boundary);

}  // namespace thermocontact::model

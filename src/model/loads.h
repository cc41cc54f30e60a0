/// Right-hand sides: body force and traction, heat source, flux and surroundings that a scene prescribes, by
/// expressions or law files, and compiled sources.
#pragma once

#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "fem/block_matrix.h"
#include "fem/form.h"
#include "scene/scene.h"

namespace thermocontact::model {

/// A linear form beside those of a scene, with the time as its only constant ("t") or none, and no
/// coefficients.
struct Source {
    fem::Kernel kernel;
    std::string boundary;  ///< name of the side it acts on; empty: over the cells
};

/// Sources of the two balances, for programs that add loads which no scene can state.
struct Sources {
    std::vector<Source> mechanical, thermal;
};

/// A sum of assembled linear forms, each with its expressions; those without t are assembled once.
class Loads {
  public:
    static Loads mechanical(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                            const std::vector<Source>& sources = {});
    static Loads thermal(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
                         const std::vector<Source>& sources = {});

    /// h theta_a of the boundaries with convection.
    static Loads ambient(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);

    /// The load vector [nodes][components] at time t (s). Throws NumericsError where something in it is not
    /// finite.
    const std::vector<double>& at(double t);

  private:
    struct AllCells {};
    using Cells = std::vector<std::int32_t>;
    using Facets = std::vector<mesh::Facet>;
    using Domain = std::variant<AllCells, Cells, Facets>;  ///< a process may have none of the cells or facets

    struct Term {
        Domain domain;
        std::vector<scene::Expression> expressions;  ///< none for compiled sources
        std::vector<double> nodal;                   ///< interpolated expressions
        std::vector<std::int32_t> nodes;
        std::unique_ptr<fem::Form> form;
        std::string law;  ///< "FILE:LINE" of a law file's; empty: none
    };

    Loads(const mesh::Mesh& mesh, const fem::Space& space, int components);
    void add(const std::string& kernel, const std::string& coefficient,
             std::vector<scene::Expression> expressions, Domain domain, const fem::Constants& constants = {});
    void add(const Source& source);
    void add_own(const std::string& kernel, const scene::Scene& scene, const scene::Law& law,
                 const std::vector<fem::Constants>& constants);
    void add_sources(const scene::Scene& scene);
    void keep(std::unique_ptr<Term> term, bool varies);
    std::vector<std::int32_t> nodes_of(const Domain& domain) const;
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

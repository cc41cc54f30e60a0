/// Elastic supports of sides: springs with the traction sigma n = -k_s (u - u_s), whose far ends are where
/// u_s says. Over each side both are of the space's degree, so that nodal forces are K_s (u - u_s).
#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <span>
#include <vector>

#include "fem/block_matrix.h"
#include "scene/scene.h"

namespace thermocontact::model {

class Springs {
  public:
    /// Keeps references to all three.
    Springs(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space);

    bool empty() const { return sides_.empty(); }

    /// matrix += factor * sum of K_s, [nodes][components].
    void add_to(double factor, fem::BlockMatrix& matrix) const;

    /// Says where the far ends are as a step begins, at its stage and at its end (times, s). Throws
    /// NumericsError where an expression has no value.
    void move(double begin, double stage, double end);

    /// forces += factor * sum of K_s (u - u_s), N, with the far ends at the stage. At nodes that processes
    /// share each has the part of its facets.
    void add_forces(double factor, const std::vector<double>& u, std::vector<double>& forces) const;

    /// Displacements of a step and what it moves by, [nodes][components]; `reach` is k w_s, what the velocity
    /// at the stage makes of the step.
    struct Motion {
        const std::vector<double>&begin, &stage, &end;
        std::function<double(std::size_t dof)> change, reach;
    };

    /// What a step does to the springs, J; this process's part.
    ///
    /// With e = u - u_s, f = K_s e at the stage, D what is changed over the step and the mean of e over its
    /// ends marked m, the work of the springs' forces f . k w_s on the left of the balance is
    ///
    ///   f . k w_s = E_n - E_(n-1) + [(e_s - e_m) . K_s De + f . (k w_s - Du)] - W,   W = -f . Du_s:
    ///
    /// stored energy E = e . K_s e/2, what the scheme dissipates by itself, and the work of those who move
    /// the far ends.
    struct Work {
        double old = 0, now = 0, numerical = 0, of_anchors = 0;
    };
    Work work(const Motion& motion) const;

    /// e . K_s e/2 of a state at time t, J; this process's part. Throws as above.
    double energy(const std::vector<double>& u, double t) const;

    /// Sums of |K_s u| (N) and |u| |K_s u| (J) over the dofs: the springs' forces are differences of K_s u
    /// and K_s u_s, whose last bits are worth something where a body has moved far; this process's part.
    struct Parts {
        double force = 0, energy = 0;
    };
    Parts parts(const std::vector<double>& u) const;

    /// Calls visit(dofs, tensor [dofs][dofs]) with the stiffness of each facet of this process, N/m.
    using Piece = std::function<void(std::span<const std::int32_t> dofs, std::span<const double> tensor)>;
    void visit_stiffness(const Piece& visit) const;

  private:
    struct Side {
        const scene::Spring* spring;
        std::vector<mesh::Facet> facets;
        std::vector<std::int32_t> nodes;        ///< of the facets, sorted
        Eigen::SparseMatrix<double> stiffness;  ///< K_s, [nodes][components] squared, N/m
        Eigen::VectorXd begin, stage, end;      ///< u_s, [nodes][components]
    };

    fem::Form form_of(const Side& side, double factor) const;
    void assemble(Side& side) const;
    Eigen::VectorXd anchor(const Side& side, double t) const;
    /// Calls use(dof, index among those of the side).
    template <typename Use>
    void for_dofs(const Side& side, Use&& use) const;
    Eigen::VectorXd at(const Side& side, const std::vector<double>& field) const;

    const mesh::Mesh* mesh_;
    const fem::Space* space_;
    int dimension_;
    std::vector<Side> sides_;
};

}  // namespace thermocontact::model

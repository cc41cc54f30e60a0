/// Contact laws assembled over their facets as a nonlinear term of the condensed unknowns.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "fem/block_matrix.h"
#include "fem/facet_form.h"
#include "model/contact_surface.h"
#include "solve/newton.h"

namespace thermocontact::model {

class FacetTerm : public solve::NonlinearTerm {
  public:
    /// `unknown` [nodes][components] is the field that the laws depend on; evaluate() writes the contact
    /// unknowns to it.
    FacetTerm(const fem::Space& space, int components, std::vector<double>& unknown);

    /// Adds one law on one surface: the forms "LAW.residual" and "LAW.jacobian".
    void add(const std::string& law, const mesh::Mesh& mesh, const ContactSurface& surface,
             const fem::Constants& constants, const fem::Fields& fields);

    /// Names the dofs that are unknowns of the condensed problem, in its order.
    void restrict_to(const std::vector<std::int32_t>& dofs);

    /// Sets k in the displacement u_old + k w of the laws (s).
    void set_step(double k);

    /// Raises the regularisation of every law to at least `floor`; 0 restores the scene's own. That is the
    /// width over which a law turns round: of friction epsilon (m/s), of conductance the limit L or the width
    /// that its file names (K).
    void raise_regularisation(double floor);

    /// Whether friction is exact on some surface: then evaluate() takes multipliers, and what solves S x +
    /// F(x) = s does so for Coulomb's law once update_multipliers() changes them no more.
    bool has_exact_friction() const;

    /// The largest diagonal entry of `matrix` per area at a node of the surfaces where friction is exact, Pa
    /// s/m; 0 without. This part's only.
    double stiffness_against_slip(const fem::BlockMatrix& matrix) const;

    /// Sets gamma of exact friction, Pa s/m.
    void set_slip_stiffness(double gamma);

    /// Says that exact friction turns round over slip velocities of about `width` (m/s), for continuation.
    void set_width_of_exact_friction(double width);

    /// lam := -sigma_t at the present values of the field. Sums of squares of this part's changes and values,
    /// and of what rounding velocities of 1 m/s makes of gamma times the slip.
    struct MultiplierChange {
        double change = 0, size = 0, rounding = 0;
    };
    MultiplierChange update_multipliers();

    /// The smallest regularisation of all laws; 0 where none has one.
    double smallest_regularisation() const;

    /// What a scene calls the regularisation that is raised, below its contact: "friction.regularisation",
    /// "conductance.limit"; empty where no law has one.
    std::string regularisation_key() const;

    /// What a regularisation must exceed, beside the unknown itself, for the laws to be linear: the largest
    /// theta_F (K), in momentum the largest component of v_F (m/s).
    double largest_foundation() const;

    /// Whether some law is friction, whose derivative is not symmetric.
    bool has_friction() const;

    bool empty() const { return laws_.empty(); }
    std::size_t law_count() const { return laws_.size(); }

    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override;
    void visit_derivative(const Eigen::VectorXd& x, const Piece& visit) override;

    /// Of compliance, which takes the displacement u_old: |dF/du| |u_old|; of conductance, which takes
    /// theta_F: |dF/dtheta_F| |theta_F|.
    void add_sensitivity(const Eigen::VectorXd& x, Eigen::VectorXd& noise) override;

    /// What the entries of F change by, at most, for a relative change of 1 of x and of the data of
    /// add_sensitivity(), summed law by law over this part; laws in the order in which they were added.
    std::vector<double> magnitudes(const Eigen::VectorXd& x);

    /// "compliance", "friction", "conductance".
    const std::string& law_name(std::size_t law) const { return laws_[law].name; }

    /// dF/dx of one law, in the order in which they were added, at the present values of the field; the
    /// unknowns of its pieces are dofs, prescribed ones included. Of exact friction only where contact
    /// presses: where it is open, the derivative of no friction at no slip is that of sticking.
    void visit_derivative_of(std::size_t law, const Piece& visit);

    /// Forces of one law ("compliance") at the current unknown into `forces` [nodes][components], prescribed
    /// dofs included. Writes only on the law's surfaces: elsewhere `forces` is zero already.
    void nodal_forces(std::string_view name, std::vector<double>& forces);

    /// The nodes that nodal_forces() writes to, ascending.
    std::vector<std::int32_t> nodes_with_forces() const;

    /// What foundations that move do on the body by friction, at the current unknown: integral of
    /// sigma_t.v_F, W; this part's only.
    double power_of_foundations();

  private:
    struct Law {
        std::string name;
        std::unique_ptr<fem::FacetNodes> nodes;
        std::unique_ptr<fem::FacetForm> residual, jacobian;
        FrictionMultiplier* multiplier;                    ///< of exact friction, else null
        std::unique_ptr<fem::Form> functional, node_area;  ///< likewise
        std::string regularised_by;                        ///< its constant's name
        std::string width_key = {};                        ///< its key, below the law's table
        double regularisation;             ///< 0: none; of exact friction the width, which is no constant
        const std::vector<double>* datum;  ///< u_old, theta_F: what is added to the unknown, or k times that
        const std::vector<double>* foundation_velocity;  ///< v_F of friction; null at rest
        std::vector<std::int32_t> dofs = {};             ///< [facets][nodes of one][components]
        /// The same: number among the contact unknowns, or -1.
        std::vector<std::int32_t> unknowns = {};

        const std::vector<mesh::Facet>& facets() const { return nodes->facets(); }
        std::span<const std::int32_t> of_facet(const std::vector<std::int32_t>& list,
                                               std::size_t facet) const {
            const std::size_t size = list.size() / facets().size();
            return {list.data() + facet * size, size};
        }
    };

    /// Calls visit(number of the facet) with the facet's multiplier shown to the forms.
    template <typename Visit>
    static void for_facets(const Law& law, Visit&& visit);

    void add_sensitivity_of(std::size_t law, Eigen::VectorXd& noise);
    void add_product_of_magnitudes(std::size_t law, double factor, const std::vector<double>& values,
                                   Eigen::VectorXd& sum);
    bool presses(std::size_t facet, std::size_t friction);
    void scatter(const Eigen::VectorXd& x);

    const fem::Space* space_;
    int components_;
    std::vector<double>* unknown_;
    double step_ = 0;            ///< k, s
    double slip_stiffness_ = 1;  ///< gamma, Pa s/m
    std::vector<Law> laws_;
    std::vector<std::int32_t> dofs_;
    std::vector<std::int32_t> index_;  ///< [dofs]: number among the contact unknowns, or -1
    std::vector<double> tensor_;
};

}  // namespace thermocontact::model

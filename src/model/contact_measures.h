/// What happens on a contact surface: resultants, shares, and fields at the nodes of its facets.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fem/form.h"
#include "model/contact_surface.h"
#include "parallel/team.h"

namespace thermocontact::model {

/// The state that contact is measured on; all [nodes][components].
struct ContactState {
    const std::vector<double>* displacement;  ///< m
    const std::vector<double>* velocity;      ///< m/s
    const std::vector<double>* temperature;   ///< K; null without heat
};

/// Resultants and shares of one surface (INTERFACE.md, final.contact).
struct ContactMeasures {
    double normal_force = 0;      ///< integral of p_n, N (N/m in 2D)
    double tangential_force = 0;  ///< norm of the resultant of sigma_t, N (N/m in 2D)
    double max_penetration = 0;   ///< largest r_+ at the nodes of the facets, m
    double contact_fraction = 0;  ///< share of the area with r >= 0
    double slip_fraction = 0;  ///< share of the area that is closed and slips, |w_t - v_Ft| > epsilon (or as
                               ///< in forms/coulomb.py)
    double heat_flow = 0;      ///< integral of q.n, W (W/m in 2D)
    double area = 0;           ///< m^2 (m in 2D)
};

/// Pointwise fields at the nodes of the facets: [facet][node of facet][components].
using FacetFields = std::map<std::string, std::vector<double>>;

class ContactProbe {
  public:
    ContactProbe(const ContactSurface& surface, const mesh::Mesh& mesh, const fem::Space& space,
                 int dimension, const ContactState& state);

    /// Over all facets of the surface, those of other processes included.
    ContactMeasures measure(const parallel::Team& team);

    /// gap (m), slip_velocity (m/s, over the foundation), and, where the laws are present, pressure (Pa),
    /// traction (Pa), heat_flow (W/m^2); where friction is exact, slips: 1 where a node does, else 0.
    FacetFields fields();

  private:
    fem::Form& form(const std::string& name) { return *forms_.at(name); }
    void add(const std::string& name, const mesh::Mesh& mesh, const fem::Constants& constants,
             const fem::Fields& fields);
    /// Calls visit(facet, the form) with the facet's multiplier shown.
    template <typename Visit>
    void for_facets(const std::string& name, Visit&& visit);
    double integral(const std::string& name);
    std::vector<double> at_nodes(const std::string& name, int components);
    /// Sum over the facets and their nodes [components].
    std::array<double, 3> resultant(const std::string& name, std::size_t components);

    const ContactSurface* surface_;
    const fem::Space* space_;
    int dimension_;
    std::string tangential_force_ = "friction.residual", traction_ = "friction.traction";
    std::string slips_ = "kinematics.";  ///< the file of the forms that say so
    std::map<std::string, std::unique_ptr<fem::Form>> forms_;
};

}  // namespace thermocontact::model

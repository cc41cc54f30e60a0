/// What nothing holds of a body without inertia: the rigid motions that neither prescribed displacements nor
/// springs nor closed contact resist. Strain does not, and the system is singular. The same of temperatures
/// without capacity: a uniform change.
///
/// With R a basis of the motions that vanish at all fixed dofs, and D the derivative of a contact law, those
/// that the law does not resist are the null vectors of R^T D R: 3 x 3 in the plane, 6 x 6 in space, for each
/// connected body. Law by law, compliance before friction: of motions that leave the gap as it is, friction's
/// D is symmetric. What counts as null is round-off (free_motions.cpp).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/bodies.h"
#include "model/facet_term.h"
#include "model/springs.h"

namespace thermocontact::model {

class FreeMotions {
  public:
    /// Of a field that no inertia (capacity) holds; `fixed` [nodes][components] marks prescribed values.
    /// Keeps references to the first three. Every process must call, here and below.
    FreeMotions(const fem::Space& space, const parallel::NodeNumbers& numbers, const parallel::Team& team,
                const std::vector<char>& fixed, int components);

    /// Leaves only the motions that springs do not resist. Every process must call.
    void hold(const Springs& springs);

    struct Found {
        std::string motions;  ///< "the body is free to move along x and to turn about (0, 1)"
        bool contact_acts;    ///< some law has a derivative that is not zero
    };

    /// What the contact laws leave free, at the present values of the field that they read.
    std::optional<Found> left_by(FacetTerm& contact) const;

  private:
    struct Body {
        Eigen::Vector3d centre;
        double size, farness;   ///< m; and of |x|/size
        Eigen::MatrixXd basis;  ///< [rigid motions][those that are free]
    };
    /// R^T D R of each body, what its terms are at most, and how often round-off met them.
    struct Quotients;

    void hold(const std::vector<char>& fixed);
    Eigen::MatrixXd motions_at(std::int32_t node) const;
    /// Calls its argument with each piece of D.
    using Pieces = std::function<void(const Springs::Piece& visit)>;
    Quotients quotients(const Pieces& pieces) const;
    static void leave(const Quotients& quotients, std::vector<Body>& bodies);
    std::string in_words(const std::vector<Body>& bodies) const;

    const fem::Space* space_;
    const parallel::NodeNumbers* numbers_;
    const parallel::Team* team_;
    int components_;
    Bodies bodies_;
    std::vector<Body> free_;  ///< [bodies]
};

}  // namespace thermocontact::model

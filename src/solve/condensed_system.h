/// A symmetric positive definite system reduced to its contact unknowns (MODEL.md, 5).
///
/// With the contact unknowns c ordered last, A = L L^T gives the Schur complement S = A_cc - A_ci A_ii^-1
/// A_ic and, for a right-hand side r, the condensed s = r_c - A_ci A_ii^-1 r_i by one forward solve. A
/// nonlinear F_c(x_c) then leaves S x_c + F_c(x_c) = s, and one backward solve gives x_i.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "fem/block_matrix.h"
#include "mesh/grid_places.h"
#include "solve/panel_factor.h"

namespace thermocontact::solve {

/// Nested dissections of the nodes outside contact, computed once for each set of contact nodes: the balances
/// of a step mostly share theirs.
class InteriorOrders {
  public:
    /// Along the planes of a grid where `places` [nodes] says where on it the nodes lie; by METIS where it is
    /// empty.
    explicit InteriorOrders(const fem::NodeGraph& graph, std::vector<mesh::GridPlace> places = {})
        : graph_(&graph), places_(std::move(places)) {}

    /// The nodes that `contact` [nodes] does not mark, in fill-reducing order.
    const std::vector<std::int32_t>& without(const std::vector<char>& contact);

  private:
    const fem::NodeGraph* graph_;
    std::vector<mesh::GridPlace> places_;
    std::map<std::vector<char>, std::vector<std::int32_t>> orders_;
};

class CondensedSystem {
  public:
    /// `fixed` [dofs] marks prescribed unknowns, which drop out; `contact` [nodes] marks the nodes whose
    /// other unknowns are kept, `interior` orders the nodes outside contact. S is computed in double
    /// precision, however the factor is stored. Throws NotPositiveDefinite with the dof at fault.
    CondensedSystem(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                    const std::vector<char>& contact, std::span<const std::int32_t> interior,
                    std::shared_ptr<Workers> workers, Storage storage = Storage::doubles);

    /// Dofs of the contact unknowns, in the order of S.
    const std::vector<std::int32_t>& contact_dofs() const { return contact_dofs_; }

    /// Dofs of all unknowns, in the order of the factor.
    const std::vector<std::int32_t>& dofs() const { return dofs_; }

    const Eigen::MatrixXd& schur_complement() const { return schur_; }

    /// Condensed right-hand side s of the full one [dofs]. Keeps what expand() needs.
    Eigen::VectorXd condense(const std::vector<double>& rhs);

    /// Writes all unknowns that are not fixed into `solution` [dofs], from the contact unknowns; false if one
    /// is not finite.
    bool expand(const Eigen::VectorXd& contact, std::vector<double>& solution);

    /// The same, but adds them to what is there.
    bool add_expanded(const Eigen::VectorXd& contact, std::vector<double>& solution);

    std::int64_t factor_entries() const { return factor_ ? factor_->entries() : 0; }
    std::int64_t factor_bytes() const { return factor_ ? factor_->bytes() : 0; }

  private:
    template <typename Work>
    void in_parts(Work&& work);
    template <typename Write>
    bool expand_by(const Eigen::VectorXd& contact, Write&& write);

    std::shared_ptr<Workers> workers_;
    std::optional<PanelFactor> factor_;  ///< empty if every dof is fixed
    std::vector<std::int32_t> dofs_;     ///< dof at each position of the factor
    std::vector<std::int32_t> contact_dofs_;
    /// [unknowns] Powers of 2, 1 in the tail: the diagonal of diag(scales) A diag(scales), which is factored,
    /// is near 1 in the head. That changes no bit of a factor in doubles, and words (column_group.h) need
    /// rows alike.
    std::vector<double> scales_;
    Eigen::MatrixXd schur_;
    std::vector<double> work_;
};

}  // namespace thermocontact::solve

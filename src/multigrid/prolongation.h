/// From a coarse level to the next finer one: the tentative prolongation Q of aggregates, made smooth by a
/// step of Jacobi's method,
///
///     P = (1 - omega A) Q,   omega = 4/3 / largest eigenvalue of A.
#pragma once

#include <cstdint>
#include <vector>

#include "multigrid/matrix.h"
#include "multigrid/scaling.h"
#include "multigrid/tentative.h"

namespace thermocontact::multigrid {

struct Prolongation {
    int fine_size = 1, coarse_size = 1;
    std::vector<std::int32_t> offsets;  ///< [fine nodes + 1]
    std::vector<std::int32_t> columns;  ///< coarse nodes of this process, by their global numbers
    std::vector<float> values;          ///< P^T by blocks: [columns][fine_size][lanes(coarse_size)]

    /// The coarse unknowns scaled: P L^-T in the place of P.
    void scale(const Scaling& coarse);

    /// fine += P coarse
    void add_to(const std::vector<float>& coarse, std::vector<float>& fine) const;

    /// coarse = P^T fine of the fine nodes that this process owns; not added up.
    void restrict_to(const std::vector<float>& fine, const SharedNodes& nodes,
                     std::vector<float>& coarse) const;
};

struct Coarsening {
    Prolongation prolongation;
    parallel::NodeNumbers numbers;  ///< of the coarse nodes
    NearNullSpace motions;          ///< [coarse nodes that this process owns], which are the first
};

/// `largest`: the eigenvalue. Every process must call.
Coarsening coarsen(const Matrix& A, double largest, const Aggregates& aggregates,
                   const NearNullSpace& motions, const SharedNodes& nodes);

}  // namespace thermocontact::multigrid

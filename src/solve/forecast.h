/// What a scene will cost by each strategy, foreseen before either is set up.
///
/// Condensing is foreseen from the symbolic Cholesky factorisation of the nodes' graph in the order in which
/// it would be factored, Newton-Krylov from the entries of the matrices. Times are bytes read at 1e10 a
/// second and operations at 2.5e10 a second, the order of magnitude of one core; the counts of products and
/// iterations are those of scenes/box.toml and scenes/paper-isotropic.toml (verification/benchmark.py
/// --study ladder measures how far the choice is from the better strategy).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/block_matrix.h"

namespace thermocontact::solve {

/// One balance as both strategies see it.
struct BalanceSize {
    double unknowns = 0;
    double matrix_entries = 0;  ///< both triangles
    double contact_unknowns = 0;
    double factor_entries = 0;     ///< of L, the dense triangle of the contact unknowns among them
    double factor_operations = 0;  ///< to compute L
};

struct Cost {
    double bytes = 0, seconds = 0;

    Cost& operator+=(const Cost& other) {
        bytes += other.bytes;
        seconds += other.seconds;
        return *this;
    }
};

/// Of a balance with `components` unknowns a node, were it factored in the order `interior` and then the
/// nodes that `contact` [nodes] marks. Prescribed unknowns count too. Throws std::bad_alloc.
BalanceSize measure(const fem::NodeGraph& graph, int components, const std::vector<char>& contact,
                    std::span<const std::int32_t> interior);

/// The same without the factor, for contact too large to be dense.
BalanceSize measure(const fem::NodeGraph& graph, int components, const std::vector<char>& contact);

/// `bytes_a_number`: of the factor as the steps read it, 8 or 4.
Cost condensed_cost(const BalanceSize& balance, int steps, double bytes_a_number = sizeof(double));
Cost newton_krylov_cost(const BalanceSize& balance, int steps);

/// Whether factor and dense block have indices of 32 bits.
bool can_condense(const BalanceSize& balance);

inline constexpr double petsc_start = 0.1;  ///< s, to load and start PETSc and MPI

}  // namespace thermocontact::solve

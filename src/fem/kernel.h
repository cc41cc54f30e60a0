/// One compiled form, freed from the differences between UFCx versions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fem/kernel_table.h"

namespace thermocontact::fem {

/// UFCx element kernel: adds to A [row-major], from all coefficients w, all constants c and the nodes x
/// [n][3].
using Tabulate = void (*)(double* A, const double* w, const double* c, const double* x, const int* facet,
                          const std::uint8_t* permutation);

struct Integral {
    int subdomain;  ///< -1: everywhere
    Tabulate tabulate;
};

struct Kernel {
    std::string name;  ///< "compliance.jacobian"
    int rank;
    std::vector<std::string> coefficients;  ///< names, in the order in which w holds them
    std::vector<std::string> constants;     ///< names, in the order in which c holds them
    std::vector<Integral> cells;
    std::vector<Integral> facets;
};

/// A table of kernels: the linked one, or another that stands beside it.
using KernelTable = std::span<const thermocontact_kernel>;

/// The kernels of forms/, which every program has.
KernelTable linked_kernels();

/// Looks `name` up in the table. Throws std::logic_error if it was not compiled for the cell and degree.
Kernel find_kernel(const std::string& name, const std::string& cell, int degree,
                   KernelTable table = linked_kernels());

/// The same in `own`, or where it is not there in `others`: those of a scene's law files
/// stand before the built-in ones.
Kernel kernel_in_force(const std::string& name, const std::string& cell, int degree, KernelTable own,
                       KernelTable others = linked_kernels());

/// "FFCx 0.5.0, UFL 2022.2.0; forms 0123456789abcdef": what the linked kernels came from.
std::string kernel_provenance();

}  // namespace thermocontact::fem

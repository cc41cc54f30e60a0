#include "fem/plane_rows.h"

#include "prefetch.h"

namespace thermocontact::fem {
namespace {

/// A block row by row: entry m is own[m] D[m] + mirrored D[3 - m], for D^T swaps the entries 1 and 2, and the
/// trace adds 3 to 0 and 0 to 3.
struct Weights {
    double own[4], mirrored;

    explicit Weights(const Isotropic& tensor)
        : own{tensor.trace + tensor.shear, tensor.trace, tensor.trace, tensor.trace + tensor.shear},
          mirrored(tensor.shear / 2) {}
};

/// The two values at a node for each row of a block, and each of them for all of its columns.
struct AtNode {
    double by_column[4], by_row[4];

    explicit AtNode(const double* x) : by_column{x[0], x[1], x[0], x[1]}, by_row{x[0], x[0], x[1], x[1]} {}
};

/// What the rows of one node add up to, entry by entry of the blocks.
struct RowSums {
    double diagonal[4] = {}, others[4] = {};

    double total(std::size_t row) const {
        return diagonal[2 * row] + diagonal[2 * row + 1] + others[2 * row] + others[2 * row + 1];
    }
    /// x_i . (A_ii x_i + 2 sum_{j > i} A_ij x_j).
    double square(const double* x) const {
        double sum = 0;
        for (std::size_t r = 0; r < 2; ++r) {
            sum += x[r] * (diagonal[2 * r] + diagonal[2 * r + 1] + 2 * (others[2 * r] + others[2 * r + 1]));
        }
        return sum;
    }
};

inline void add_diagonal(const Weights& weights, const double* block, const AtNode& x, double* sums) {
#pragma omp simd
    for (int m = 0; m < 4; ++m) {
        sums[m] = (weights.own[m] * block[m] + weights.mirrored * block[3 - m]) * x.by_column[m];
    }
}

double add_rows(const PlaneProducts& products, NodeRange range, const Target& elastic,
                const Target& viscous) {
    const NodeGraph& graph = *products.divergences->graph;
    const std::ptrdiff_t first = graph.offsets[static_cast<std::size_t>(range.begin)];
    const std::int32_t* column = graph.columns.data() + first;
    const double* block = products.divergences->values.data() + 4 * first;
    const double *u = products.u->data(), *w = products.w->data();
    const Weights E(products.elasticity), V(products.viscosity), norm({0, 1});
    double square = 0;
    for (std::ptrdiff_t i = range.begin; i < range.end; ++i) {
        const std::int32_t* end = graph.columns.data() + graph.offsets[static_cast<std::size_t>(i) + 1];
        const AtNode u_here(u + 2 * i), w_here(w + 2 * i);
        RowSums of_u, of_w, of_norm;
        add_diagonal(E, block, u_here, of_u.diagonal);
        add_diagonal(V, block, w_here, of_w.diagonal);
        add_diagonal(norm, block, u_here, of_norm.diagonal);
        for (++column, block += 4; column < end; ++column, block += 4) {
            prefetch_after<4>(block);
            const std::ptrdiff_t j = std::ptrdiff_t{*column} * 2;
            const AtNode u_there(u + j), w_there(w + j);
            double to_u[4], to_w[4];
#pragma omp simd
            for (int m = 0; m < 4; ++m) {
                const double elastic_entry = E.own[m] * block[m] + E.mirrored * block[3 - m];
                const double viscous_entry = V.own[m] * block[m] + V.mirrored * block[3 - m];
                const double norm_entry = norm.own[m] * block[m] + norm.mirrored * block[3 - m];
                of_u.others[m] += elastic_entry * u_there.by_column[m];
                of_w.others[m] += viscous_entry * w_there.by_column[m];
                of_norm.others[m] += norm_entry * u_there.by_column[m];
                to_u[m] = elastic_entry * u_here.by_row[m];
                to_w[m] = viscous_entry * w_here.by_row[m];
            }
#pragma omp simd
            for (int c = 0; c < 2; ++c) {
                elastic.later[j + c] += to_u[c] + to_u[2 + c];
            }
#pragma omp simd
            for (int c = 0; c < 2; ++c) {
                viscous.later[j + c] += to_w[c] + to_w[2 + c];
            }
        }
        for (std::ptrdiff_t r = 0; r < 2; ++r) {
            elastic.here[2 * i + r] += of_u.total(static_cast<std::size_t>(r));
            viscous.here[2 * i + r] += of_w.total(static_cast<std::size_t>(r));
        }
        square += of_norm.square(u + 2 * i);
    }
    return square;
}

}  // namespace

Pass pass_of(const PlaneProducts& products) {
    return {.results = {Pass::Result{products.elastic}, Pass::Result{products.viscous}},
            .add =
                [&products](NodeRange range, const std::array<Target, 2>& results) {
                    return add_rows(products, range, results[0], results[1]);
                },
            .square = products.strain_square};
}

BlockMatrix isotropic_matrix(const BlockMatrix& divergences, const Isotropic& tensor) {
    const Weights weights(tensor);
    BlockMatrix result = divergences;
    for (std::size_t i = 0; i < result.values.size(); i += 4) {
        const double* block = &divergences.values[i];
        for (std::size_t m = 0; m < 4; ++m) {
            result.values[i + m] = weights.own[m] * block[m] + weights.mirrored * block[3 - m];
        }
    }
    return result;
}

}  // namespace thermocontact::fem

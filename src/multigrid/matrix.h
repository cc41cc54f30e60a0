/// The matrix of a level: symmetric, its upper triangle by blocks, those on its diagonal the identity
/// (scaling.h). Of several processes each holds a part; the parts add up.
#pragma once

#include <cstdint>
#include <vector>

namespace thermocontact::multigrid {

struct Matrix {
    int size = 1;                       ///< unknowns of a node
    std::vector<std::int32_t> offsets;  ///< [nodes + 1]
    std::vector<std::int32_t> columns;  ///< of each node: itself, then those after it that couple, in order
    std::vector<float> values;          ///< [pairs][size][lanes(size)], see blocks.h

    std::int32_t node_count() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    std::size_t block_length() const;
    float* block(std::size_t pair) { return values.data() + pair * block_length(); }
    const float* block(std::size_t pair) const { return values.data() + pair * block_length(); }

    /// Where the block of nodes i <= j stands. Throws std::logic_error if they do not couple.
    std::size_t pair(std::int32_t i, std::int32_t j) const;

    /// y -= A x of this part; padded nodal vectors.
    void subtract_product(const std::vector<float>& x, std::vector<float>& y) const;
};

}  // namespace thermocontact::multigrid

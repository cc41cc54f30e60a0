#include "multigrid/matrix.h"

#include <algorithm>
#include <stdexcept>

#include "multigrid/blocks.h"
#include "prefetch.h"

namespace thermocontact::multigrid {
namespace {

template <int size>
void subtract_blocks(const Matrix& A, const float* x, float* y) {
    constexpr std::ptrdiff_t stride = lanes(size), length = stride * size;
    const std::int32_t* column = A.columns.data();
    const float* block = A.values.data();
    for (std::ptrdiff_t i = 0; i < A.node_count(); ++i) {
        const std::int32_t* end = A.columns.data() + A.offsets[static_cast<std::size_t>(i) + 1];
        const Column<size> here = -ConstColumnMap<size>(x + i * stride);
        Column<size> sum = product<size, size>(block, x + i * stride);
        for (++column, block += length; column < end; ++column, block += length) {
            prefetch_after<static_cast<std::size_t>(length)>(block);
            const std::ptrdiff_t j = *column * stride;
            sum += product<size, size>(block, x + j);
            add_transposed_product<size, size>(block, here, y + j);
        }
        ColumnMap<size>(y + i * stride) -= sum;
    }
}

}  // namespace

std::size_t Matrix::block_length() const {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(lanes(size));
}

std::size_t Matrix::pair(std::int32_t i, std::int32_t j) const {
    const auto begin = columns.begin() + offsets[static_cast<std::size_t>(i)];
    const auto end = columns.begin() + offsets[static_cast<std::size_t>(i) + 1];
    const auto found = std::lower_bound(begin, end, j);
    if (found == end || *found != j) {
        throw std::logic_error("multigrid: a contact piece couples nodes that no cell couples");
    }
    return static_cast<std::size_t>(found - columns.begin());
}

void Matrix::subtract_product(const std::vector<float>& x, std::vector<float>& y) const {
    with_size(size, [&]<int n>() { subtract_blocks<n>(*this, x.data(), y.data()); });
}

}  // namespace thermocontact::multigrid

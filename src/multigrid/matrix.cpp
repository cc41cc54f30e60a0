#include "multigrid/matrix.h"

#include <algorithm>
#include <stdexcept>

#include "multigrid/blocks.h"

namespace thermocontact::multigrid {
namespace {

template <int size>
void multiply_blocks(const Matrix& A, const float* x, float* y) {
    constexpr std::ptrdiff_t stride = lanes(size), length = stride * size;
    const std::int32_t* column = A.columns.data();
    const float* block = A.values.data();
    for (std::ptrdiff_t i = 0; i < A.node_count(); ++i) {
        const std::int32_t* end = A.columns.data() + A.offsets[static_cast<std::size_t>(i) + 1];
        const Column<size> here = ConstColumnMap<size>(x + i * stride);
        Column<size> sum = product<size, size>(block, x + i * stride);
        for (++column, block += length; column < end; ++column, block += length) {
            const std::ptrdiff_t j = *column * stride;
            sum += product<size, size>(block, x + j);
            add_transposed_product<size, size>(block, here, y + j);
        }
        ColumnMap<size>(y + i * stride) += sum;
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

void Matrix::multiply(const std::vector<float>& x, std::vector<float>& y) const {
    std::ranges::fill(y, 0.0F);
    with_size(size, [&]<int n>() { multiply_blocks<n>(*this, x.data(), y.data()); });
}

namespace {

void add_pieces(const Pieces& D, double scale, Matrix& A) {
    const std::int32_t size = A.size;
    const auto stride = static_cast<std::size_t>(lanes(size));
    const std::int32_t* dofs = D.dofs.data();
    const double* values = D.values.data();
    for (const std::int32_t n : D.sizes) {
        for (std::int32_t r = 0; r < n; ++r) {
            for (std::int32_t c = 0; c < n; ++c) {
                const std::int32_t i = dofs[r] / size, j = dofs[c] / size;
                if (i > j) {
                    continue;
                }
                const double mean = (values[r * n + c] + values[c * n + r]) / 2;
                const auto row = static_cast<std::size_t>(dofs[r] % size);
                const auto column = static_cast<std::size_t>(dofs[c] % size);
                A.block(A.pair(i, j))[column * stride + row] += static_cast<float>(mean / scale);
            }
        }
        dofs += n;
        values += std::ptrdiff_t{n} * n;
    }
}

}  // namespace

Matrix fine_matrix(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                   const std::vector<float>& holders, double scale) {
    const auto size = static_cast<std::size_t>(A.rows);
    const auto stride = static_cast<std::size_t>(lanes(A.rows));
    Matrix result{A.rows, A.graph->offsets, A.graph->columns, {}};
    result.values.assign(result.columns.size() * result.block_length(), 0.0F);
    for (std::size_t i = 0; i + 1 < result.offsets.size(); ++i) {
        const auto first = static_cast<std::size_t>(result.offsets[i]);
        for (auto pair = first; pair < static_cast<std::size_t>(result.offsets[i + 1]); ++pair) {
            const auto j = static_cast<std::size_t>(result.columns[pair]);
            float* block = result.block(pair);
            for (std::size_t r = 0; r < size; ++r) {
                for (std::size_t c = 0; c < size; ++c) {
                    if (fixed[i * size + r] == 0 && fixed[j * size + c] == 0) {
                        block[c * stride + r] =
                            static_cast<float>(A.values[(pair * size + r) * size + c] / scale);
                    }
                }
                if (i == j && fixed[i * size + r] != 0) {
                    block[r * stride + r] = 1.0F / holders[i];
                }
            }
        }
    }
    add_pieces(D, scale, result);
    return result;
}

}  // namespace thermocontact::multigrid

#include "fem/matrix_rows.h"

#include <utility>

namespace thermocontact::fem {

MatrixRows::MatrixRows(const BlockMatrix& matrix, std::span<const std::int32_t> dofs)
    : dofs_(dofs.begin(), dofs.end()) {
    const NodeGraph& graph = *matrix.graph;
    const std::int32_t b = matrix.rows, nodes = graph.node_count();
    std::vector<std::int32_t> place(static_cast<std::size_t>(nodes * b), -1);  // in the list, of a dof
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
        place[static_cast<std::size_t>(dofs_[i])] = static_cast<std::int32_t>(i);
    }
    std::vector<std::vector<std::pair<std::int32_t, double>>> rows(dofs_.size());
    const auto take = [&](std::int32_t row, std::int32_t column, double value) {
        if (const std::int32_t at = place[static_cast<std::size_t>(row)]; at >= 0) {
            rows[static_cast<std::size_t>(at)].emplace_back(column, value);
        }
    };
    const double* value = matrix.values.data();
    for (std::int32_t i = 0; i < nodes; ++i) {
        for (auto p = graph.offsets[static_cast<std::size_t>(i)];
             p < graph.offsets[static_cast<std::size_t>(i) + 1]; ++p) {
            const std::int32_t j = graph.columns[static_cast<std::size_t>(p)];
            for (std::int32_t r = 0; r < b; ++r) {
                for (std::int32_t c = 0; c < b; ++c, ++value) {
                    take(i * b + r, j * b + c, *value);
                    if (i != j) {
                        take(j * b + c, i * b + r, *value);
                    }
                }
            }
        }
    }
    offsets_.push_back(0);
    for (const auto& row : rows) {
        for (const auto& [column, entry] : row) {
            columns_.push_back(column);
            values_.push_back(entry);
        }
        offsets_.push_back(columns_.size());
    }
}

void MatrixRows::multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t i = 0; i < dofs_.size(); ++i) {
        double sum = 0;
        for (std::size_t p = offsets_[i]; p < offsets_[i + 1]; ++p) {
            sum += values_[p] * x[static_cast<std::size_t>(columns_[p])];
        }
        y[static_cast<std::size_t>(dofs_[i])] = sum;
    }
}

}  // namespace thermocontact::fem

/// Sparse things as dense ones, for comparison.
#pragma once

#include <Eigen/Core>
#include <random>

#include "fem/block_matrix.h"

namespace thermocontact::support {

inline Eigen::MatrixXd dense(const fem::BlockMatrix& matrix) {
    const fem::NodeGraph& graph = *matrix.graph;
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(graph.node_count() * matrix.rows, graph.node_count() * matrix.columns);
    const int size = matrix.rows * matrix.columns;
    const auto block = [&](int position) {
        using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        return Eigen::Map<const Block>(&matrix.values[position * size], matrix.rows, matrix.columns);
    };
    const auto part = [&](int row, int column) {
        return result.block(row * matrix.rows, column * matrix.columns, matrix.rows, matrix.columns);
    };
    for (int node = 0; node < graph.node_count(); ++node) {
        for (int i = graph.offsets[node]; i < graph.offsets[node + 1]; ++i) {
            const int other = graph.columns[i];
            part(node, other) += block(matrix.symmetric() ? i : 2 * i);
            if (!matrix.symmetric()) {
                part(other, node) += block(2 * i + 1);
            } else if (other != node) {
                part(other, node) += block(i).transpose();
            }
        }
    }
    return result;
}

inline Eigen::VectorXd as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Of dynamic size: GCC 12 warns falsely of fixed-size vectors in its own AVX-512 intrinsics.
inline Eigen::VectorXd vector(std::initializer_list<double> values) {
    return as_vector(values);
}

inline std::vector<double> as_std(const Eigen::VectorXd& values) {
    return {values.begin(), values.end()};
}

/// Numbers in (-1, 1), the same in every run.
inline std::vector<double> random_numbers(std::size_t count, unsigned seed = 1) {
    std::mt19937 engine(seed);
    std::vector<double> result(count);
    for (double& value : result) {
        value = 2.0 * static_cast<double>(engine()) / 4294967296.0 - 1.0;
    }
    return result;
}

}  // namespace thermocontact::support

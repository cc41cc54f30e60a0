#include "solve/condensed_system.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "solve/grid_dissection.h"

namespace thermocontact::solve {
namespace {

/// Free unknowns: their dofs, and the inverse map (-1 where fixed).
struct FreeDofs {
    std::vector<std::int32_t> dofs;
    std::vector<std::int32_t> index;
};

FreeDofs number_free(const std::vector<char>& fixed) {
    FreeDofs free{{}, std::vector<std::int32_t>(fixed.size(), -1)};
    for (std::size_t dof = 0; dof < fixed.size(); ++dof) {
        if (fixed[dof] == 0) {
            free.index[dof] = static_cast<std::int32_t>(free.dofs.size());
            free.dofs.push_back(static_cast<std::int32_t>(dof));
        }
    }
    return free;
}

std::vector<std::int32_t> nodes_outside(const std::vector<char>& contact) {
    std::vector<std::int32_t> nodes;
    for (std::size_t node = 0; node < contact.size(); ++node) {
        if (contact[node] == 0) {
            nodes.push_back(static_cast<std::int32_t>(node));
        }
    }
    return nodes;
}

/// Nested dissection of the nodes that are not in contact, by METIS.
std::vector<std::int32_t> order_interior(const fem::NodeGraph& graph, const std::vector<char>& contact) {
    const std::vector<std::int32_t> nodes = nodes_outside(contact);
    std::vector<std::int32_t> index(contact.size(), -1);  // -1 marks the others
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        index[static_cast<std::size_t>(nodes[i])] = static_cast<std::int32_t>(i);
    }
    SymmetricMatrix pattern{static_cast<std::int32_t>(nodes.size()), {0}, {}, {}};
    for (const std::int32_t node : nodes) {
        const auto begin = graph.offsets[static_cast<std::size_t>(node)],
                   end = graph.offsets[static_cast<std::size_t>(node) + 1];
        for (auto i = begin; i < end; ++i) {
            const auto other = graph.columns[static_cast<std::size_t>(i)];
            if (other >= node && index[static_cast<std::size_t>(other)] >= 0) {
                pattern.rows.push_back(index[static_cast<std::size_t>(other)]);
            }
        }
        pattern.offsets.push_back(static_cast<std::int32_t>(pattern.rows.size()));
    }
    std::vector<std::int32_t> order = nested_dissection(pattern);
    std::ranges::transform(order, order.begin(),
                           [&](std::int32_t i) { return nodes[static_cast<std::size_t>(i)]; });
    return order;
}

/// Lower triangle of A over the free unknowns; those of contact nodes couple densely, so that they end as one
/// block.
SymmetricMatrix reduce(const fem::BlockMatrix& matrix, const FreeDofs& free,
                       const std::vector<std::int32_t>& tail, const std::vector<char>& contact) {
    const fem::NodeGraph& graph = *matrix.graph;
    const auto b = static_cast<std::size_t>(matrix.rows);
    SymmetricMatrix result{static_cast<std::int32_t>(free.dofs.size()), {0}, {}, {}};
    std::vector<double> dense(free.dofs.size(), 0.0);  // one column's entries in contact rows
    const auto append = [&](std::int32_t row, double value) {
        result.rows.push_back(row);
        result.values.push_back(value);
    };
    for (std::int32_t column = 0; column < result.size; ++column) {
        const auto dof = static_cast<std::size_t>(free.dofs[static_cast<std::size_t>(column)]);
        const std::size_t node = dof / b, c = dof % b;
        const bool in_tail = contact[node] != 0;
        for (auto i = static_cast<std::size_t>(graph.offsets[node]);
             i < static_cast<std::size_t>(graph.offsets[node + 1]); ++i) {
            const auto other = static_cast<std::size_t>(graph.columns[i]);
            for (std::size_t r = 0; r < b; ++r) {
                const std::int32_t row = free.index[other * b + r];
                if (row < column) {
                    continue;
                }
                // by symmetry, row node's blocks serve as column node's: A[other, r][node, c] = A[node,
                // c][other, r]
                const double value = matrix.values[(i * b + c) * b + r];
                if (in_tail && contact[other] != 0) {
                    dense[static_cast<std::size_t>(row)] = value;
                } else {
                    append(row, value);
                }
            }
        }
        if (in_tail) {
            for (auto row = std::ranges::lower_bound(tail, column); row != tail.end(); ++row) {
                append(*row, std::exchange(dense[static_cast<std::size_t>(*row)], 0.0));
            }
            // merge the two sorted runs of this column
            std::vector<std::pair<std::int32_t, double>> entries;
            for (auto i = static_cast<std::size_t>(result.offsets.back()); i < result.rows.size(); ++i) {
                entries.emplace_back(result.rows[i], result.values[i]);
            }
            std::ranges::sort(entries, {}, &std::pair<std::int32_t, double>::first);
            for (std::size_t i = 0; i < entries.size(); ++i) {
                const auto at = static_cast<std::size_t>(result.offsets.back()) + i;
                std::tie(result.rows[at], result.values[at]) = entries[i];
            }
        }
        result.offsets.push_back(static_cast<std::int32_t>(result.rows.size()));
    }
    return result;
}

/// Powers of 2 that bring the head's diagonal into [1/2, 2]; 1 in the tail, and where an entry is no pivot.
std::vector<double> equilibrating(const SymmetricMatrix& matrix, const std::vector<std::int32_t>& tail) {
    std::vector<double> scales(static_cast<std::size_t>(matrix.size), 1.0);
    for (std::size_t row = 0; row < scales.size(); ++row) {
        const double diagonal = matrix.values[static_cast<std::size_t>(matrix.offsets[row])];
        if (std::isnormal(diagonal) && diagonal > 0) {
            scales[row] = std::ldexp(1.0, -std::ilogb(diagonal) / 2);
        }
    }
    for (const std::int32_t row : tail) {
        scales[static_cast<std::size_t>(row)] = 1;
    }
    return scales;
}

/// matrix := diag(scales) matrix diag(scales).
void scale(SymmetricMatrix& matrix, const std::vector<double>& scales) {
    for (std::size_t column = 0; column < scales.size(); ++column) {
        for (auto i = static_cast<std::size_t>(matrix.offsets[column]);
             i < static_cast<std::size_t>(matrix.offsets[column + 1]); ++i) {
            matrix.values[i] *= scales[column] * scales[static_cast<std::size_t>(matrix.rows[i])];
        }
    }
}

/// Mean diagonal entry over the contact unknowns.
double mean_diagonal(const SymmetricMatrix& matrix, const std::vector<std::int32_t>& tail) {
    double sum = 0;
    for (const std::int32_t row : tail) {
        sum += matrix.values[static_cast<std::size_t>(matrix.offsets[static_cast<std::size_t>(row)])];
    }
    return tail.empty() ? 0.0 : sum / static_cast<double>(tail.size());
}

}  // namespace

const std::vector<std::int32_t>& InteriorOrders::without(const std::vector<char>& contact) {
    const auto known = orders_.find(contact);
    if (known != orders_.end()) {
        return known->second;
    }
    return orders_[contact] = places_.empty() ? order_interior(*graph_, contact)
                                              : grid_dissection(places_, nodes_outside(contact));
}

CondensedSystem::CondensedSystem(const fem::BlockMatrix& matrix, const std::vector<char>& fixed,
                                 const std::vector<char>& contact, std::span<const std::int32_t> interior,
                                 std::shared_ptr<Workers> workers, Storage storage)
    : workers_(std::move(workers)) {
    const FreeDofs free = number_free(fixed);
    if (free.dofs.empty()) {
        schur_.resize(0, 0);
        return;
    }
    const auto b = static_cast<std::size_t>(matrix.rows);
    std::vector<std::int32_t> order, tail;
    for (const std::int32_t node : interior) {
        for (std::size_t c = 0; c < b; ++c) {
            if (const auto i = free.index[static_cast<std::size_t>(node) * b + c]; i >= 0) {
                order.push_back(i);
            }
        }
    }
    for (std::size_t i = 0; i < free.dofs.size(); ++i) {
        if (contact[static_cast<std::size_t>(free.dofs[i]) / b] != 0) {
            tail.push_back(static_cast<std::int32_t>(i));
        }
    }
    order.insert(order.end(), tail.begin(), tail.end());

    // A body that only contact holds has a singular A but regular A_ii: a shift of A_cc, taken back from S,
    // lets the factorisation pass and changes nothing else.
    SymmetricMatrix reduced = reduce(matrix, free, tail, contact);
    const double shift = mean_diagonal(reduced, tail);
    for (const std::int32_t row : tail) {
        reduced.values[static_cast<std::size_t>(reduced.offsets[static_cast<std::size_t>(row)])] += shift;
    }
    const std::vector<double> scales = equilibrating(reduced, tail);
    scale(reduced, scales);
    try {
        factor_.emplace(reduced, order, static_cast<std::int32_t>(tail.size()), workers_, storage);
    } catch (const NotPositiveDefinite& failure) {
        throw NotPositiveDefinite{free.dofs[static_cast<std::size_t>(failure.row)]};
    }
    for (const std::int32_t i : factor_->order()) {
        dofs_.push_back(free.dofs[static_cast<std::size_t>(i)]);
        scales_.push_back(scales[static_cast<std::size_t>(i)]);
    }
    contact_dofs_.assign(dofs_.end() - static_cast<std::ptrdiff_t>(tail.size()), dofs_.end());
    schur_ = factor_->schur_complement();
    schur_.diagonal().array() -= shift;
    work_.resize(dofs_.size());
}

/// Calls work(begin, end, part) for parts of the unknowns, beside each other.
template <typename Work>
void CondensedSystem::in_parts(Work&& work) {
    constexpr std::size_t part_size = 16384;  // far more than waking a thread takes
    const std::size_t parts = (dofs_.size() + part_size - 1) / part_size;
    workers_->run(static_cast<int>(parts), [&](int number) {
        const auto part = static_cast<std::size_t>(number);
        work(part * part_size, std::min(dofs_.size(), (part + 1) * part_size), part);
    });
}

Eigen::VectorXd CondensedSystem::condense(const std::vector<double>& rhs) {
    if (!factor_) {
        return {};
    }
    in_parts([&](std::size_t begin, std::size_t end, std::size_t) {
        double* values = work_.data();
        for (std::size_t i = begin; i < end; ++i) {
            values[i] = scales_[i] * rhs[static_cast<std::size_t>(dofs_[i])];
        }
    });
    factor_->forward(work_);
    const auto count = static_cast<Eigen::Index>(contact_dofs_.size());
    return Eigen::Map<const Eigen::VectorXd>(work_.data() + work_.size() - contact_dofs_.size(), count);
}

/// Calls write(dof, value) for all unknowns; false if a value is not finite.
template <typename Write>
bool CondensedSystem::expand_by(const Eigen::VectorXd& contact, Write&& write) {
    if (!factor_) {
        return true;
    }
    std::copy(contact.begin(), contact.end(), work_.end() - contact.size());
    factor_->backward(work_);
    std::atomic<bool> finite = true;
    in_parts([&](std::size_t begin, std::size_t end, std::size_t) {
        double zeros = 0;  // as long as all are finite
        const double *values = work_.data(), *scales = scales_.data();
        const std::int32_t* dofs = dofs_.data();
#pragma omp simd reduction(+ : zeros)
        for (std::size_t i = begin; i < end; ++i) {
            zeros += 0 * values[i];
        }
        for (std::size_t i = begin; i < end; ++i) {
            write(static_cast<std::size_t>(dofs[i]), scales[i] * values[i]);
        }
        if (zeros != 0) {
            finite = false;
        }
    });
    return finite;
}

bool CondensedSystem::expand(const Eigen::VectorXd& contact, std::vector<double>& solution) {
    return expand_by(contact, [&](std::size_t dof, double value) { solution[dof] = value; });
}

bool CondensedSystem::add_expanded(const Eigen::VectorXd& contact, std::vector<double>& solution) {
    return expand_by(contact, [&](std::size_t dof, double value) { solution[dof] += value; });
}

}  // namespace thermocontact::solve

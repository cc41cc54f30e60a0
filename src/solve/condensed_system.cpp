#include "solve/condensed_system.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "solve/grid_dissection.h"

namespace thermocontact::solve {
namespace {

/// Free unknowns in the order in which they are eliminated, those of contact nodes last: their dofs, and the
/// inverse map (-1 where fixed).
struct FreeDofs {
    std::vector<std::int32_t> dofs;
    std::vector<std::int32_t> index;
    std::int32_t contact = 0;  ///< how many of them, the last, are of contact nodes
};

FreeDofs number_free(const std::vector<char>& fixed, const std::vector<char>& contact,
                     std::span<const std::int32_t> interior) {
    FreeDofs free{{}, std::vector<std::int32_t>(fixed.size(), -1)};
    const std::size_t b = fixed.size() / contact.size();
    const auto number_node = [&](std::size_t node) {
        for (std::size_t dof = node * b; dof < (node + 1) * b; ++dof) {
            if (fixed[dof] == 0) {
                free.index[dof] = static_cast<std::int32_t>(free.dofs.size());
                free.dofs.push_back(static_cast<std::int32_t>(dof));
            }
        }
    };
    for (const std::int32_t node : interior) {
        number_node(static_cast<std::size_t>(node));
    }
    const std::size_t head = free.dofs.size();
    for (std::size_t node = 0; node < contact.size(); ++node) {
        if (contact[node] != 0) {
            number_node(node);
        }
    }
    free.contact = static_cast<std::int32_t>(free.dofs.size() - head);
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

/// Calls call(column, row, value) with the entries of A's lower triangle over the free unknowns.
template <typename Call>
void each_entry(const fem::BlockMatrix& matrix, const FreeDofs& free, Call&& call) {
    const fem::NodeGraph& graph = *matrix.graph;
    const auto b = static_cast<std::size_t>(matrix.rows);
    for (std::size_t node = 0; node + 1 < graph.offsets.size(); ++node) {
        for (auto i = static_cast<std::size_t>(graph.offsets[node]);
             i < static_cast<std::size_t>(graph.offsets[node + 1]); ++i) {
            const auto other = static_cast<std::size_t>(graph.columns[i]);
            for (std::size_t entry = 0; entry < b * b; ++entry) {
                const std::size_t c = entry / b, r = entry % b;
                const auto [column, row] = std::minmax({free.index[node * b + c], free.index[other * b + r]});
                if (column >= 0 && (other != node || r >= c)) {
                    call(static_cast<std::size_t>(column), row, matrix.values[i * b * b + entry]);
                }
            }
        }
    }
}

/// Lower triangle of A over the free unknowns, of each column the diagonal first; those of contact nodes
/// couple densely, so that they end as one block.
SymmetricMatrix reduce(const fem::BlockMatrix& matrix, const FreeDofs& free) {
    const std::size_t size = free.dofs.size(), head = size - static_cast<std::size_t>(free.contact);
    SymmetricMatrix result{static_cast<std::int32_t>(size), std::vector<std::int32_t>(size + 1, 0), {}, {}};
    each_entry(matrix, free, [&](std::size_t column, std::int32_t, double) { ++result.offsets[column + 1]; });
    for (std::size_t column = head; column < size; ++column) {
        result.offsets[column + 1] = static_cast<std::int32_t>(size - column);
    }
    std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
    result.rows.resize(static_cast<std::size_t>(result.offsets.back()));
    result.values.resize(result.rows.size(), 0.0);
    std::vector<std::size_t> next(head);  // behind the diagonal
    for (std::size_t column = 0; column < size; ++column) {
        const auto begin = result.rows.begin() + result.offsets[column];
        std::iota(begin, column < head ? begin + 1 : begin + static_cast<std::ptrdiff_t>(size - column),
                  static_cast<std::int32_t>(column));
        if (column < head) {
            next[column] = static_cast<std::size_t>(result.offsets[column]) + 1;
        }
    }
    each_entry(matrix, free, [&](std::size_t column, std::int32_t row, double value) {
        const std::size_t below = static_cast<std::size_t>(row) - column;
        const bool has_place = below == 0 || column >= head;
        const std::size_t at =
            has_place ? static_cast<std::size_t>(result.offsets[column]) + below : next[column]++;
        result.rows[at] = row;
        result.values[at] = value;
    });
    return result;
}

/// Powers of 2 that bring the head's diagonal into [1/2, 2]; 1 in the tail, and where an entry is no pivot.
std::vector<double> equilibrating(const SymmetricMatrix& matrix, std::int32_t tail) {
    std::vector<double> scales(static_cast<std::size_t>(matrix.size), 1.0);
    for (std::size_t row = 0; row < static_cast<std::size_t>(matrix.size - tail); ++row) {
        const double diagonal = matrix.values[static_cast<std::size_t>(matrix.offsets[row])];
        if (std::isnormal(diagonal) && diagonal > 0) {
            scales[row] = std::ldexp(1.0, -std::ilogb(diagonal) / 2);
        }
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

/// Adds to the diagonal over the contact unknowns its mean, which is returned.
double shift_tail(SymmetricMatrix& matrix, std::int32_t tail) {
    const auto each_diagonal = [&](auto&& call) {
        for (std::int32_t row = matrix.size - tail; row < matrix.size; ++row) {
            call(matrix.values[static_cast<std::size_t>(matrix.offsets[static_cast<std::size_t>(row)])]);
        }
    };
    double sum = 0;
    each_diagonal([&](double value) { sum += value; });
    const double shift = tail == 0 ? 0.0 : sum / static_cast<double>(tail);
    each_diagonal([&](double& value) { value += shift; });
    return shift;
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
    const FreeDofs free = number_free(fixed, contact, interior);
    if (free.dofs.empty()) {
        schur_.resize(0, 0);
        return;
    }
    // A body that only contact holds has a singular A but regular A_ii: a shift of A_cc, taken back from S,
    // lets the factorisation pass and changes nothing else.
    SymmetricMatrix reduced = reduce(matrix, free);
    const double shift = shift_tail(reduced, free.contact);
    const std::vector<double> scales = equilibrating(reduced, free.contact);
    scale(reduced, scales);
    try {
        factor_.emplace(reduced, free.contact, workers_, storage);
    } catch (const NotPositiveDefinite& failure) {
        throw NotPositiveDefinite{free.dofs[static_cast<std::size_t>(failure.row)]};
    }
    for (const std::int32_t i : factor_->order()) {
        dofs_.push_back(free.dofs[static_cast<std::size_t>(i)]);
        scales_.push_back(scales[static_cast<std::size_t>(i)]);
    }
    contact_dofs_.assign(dofs_.end() - free.contact, dofs_.end());
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

/// Loops over the nodes of a space, and products with its matrices, by several threads.
///
/// A long vector is read from memory again by every loop that goes through it. Here loops go through a range
/// of nodes after the other, whose vectors stay in a core's cache meanwhile, and products with several
/// matrices share a range, too. The ranges do not depend on how many threads there are, so that the last bit
/// of a sum does not, either.
#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "fem/block_rows.h"

namespace thermocontact::fem {

/// Calls task(0) to task(count - 1), each once, beside each other or not.
using Beside = std::function<void(int count, const std::function<void(int)>& task)>;

/// y := from + factor A x; `from` null: 0. Without `y`, square := x^T A x.
struct Product {
    const BlockMatrix* matrix;  ///< null: no product, zeros
    const std::vector<double>* x;
    std::vector<double>* y = nullptr;  ///< its size already
    double factor = 1;
    const std::vector<double>* from = nullptr;
    double* square = nullptr;
};

/// One reading of a matrix's rows, and all that is taken of it: a product, or several that share what is
/// read.
struct Pass {
    struct Result {
        std::vector<double>* y = nullptr;  ///< its size already; null: there is no such result
        const std::vector<double>* from = nullptr;
    };
    std::array<Result, 2> results{};
    /// Adds what the rows of the range contribute, and returns their part of the square; empty: nothing.
    std::function<double(NodeRange range, const std::array<Target, 2>& results)> add;
    double* square = nullptr;  ///< null: there is none
};

/// What the product refers to must stay until Traversal::run().
Pass pass_of(const Product& product);

/// total += part, member by member.
template <typename Sums>
void add_doubles(Sums& total, const Sums& part) {
    static_assert(std::is_trivially_copyable_v<Sums> && sizeof(Sums) % sizeof(double) == 0);
    constexpr std::size_t count = sizeof(Sums) / sizeof(double);
    double sums[count], more[count];
    std::memcpy(sums, &total, sizeof(Sums));
    std::memcpy(more, &part, sizeof(Sums));
    for (std::size_t i = 0; i < count; ++i) {
        sums[i] += more[i];
    }
    std::memcpy(static_cast<void*>(&total), sums, sizeof(Sums));
}

class Traversal {
  public:
    /// For the nodes of the graph, which must stay. A space with less than `range_size` nodes or a little
    /// more has one range, one without nodes (a process may have none) has none.
    Traversal(const NodeGraph& graph, Beside beside, std::int32_t range_size = 8192);

    std::size_t range_count() const { return ranges_.size(); }

    /// Calls work(range, its number) for all ranges.
    void each(const std::function<void(NodeRange, std::size_t)>& work) const;

    /// The sum of what work(range) returns for all ranges, a structure of doubles.
    template <typename Sums, typename Work>
    Sums sum(Work&& work) const {
        std::vector<Sums> parts(ranges_.size());
        each([&](NodeRange range, std::size_t number) { parts[number] = work(range); });
        Sums total{};
        for (const Sums& part : parts) {
            add_doubles(total, part);
        }
        return total;
    }

    /// All products, beside each other; none may read what another one writes.
    void multiply(std::span<const Product> products);

    /// The same for passes.
    void run(std::span<const Pass> passes);

  private:
    struct Range {
        NodeRange all;
        std::int32_t shared;  ///< rows before that couple with no node beyond the range
        std::int32_t reach;   ///< beyond the last node that the others couple with
    };

    std::vector<Range> cut(std::int32_t count) const;
    using Later = std::array<std::vector<double>, 2>;
    double run(const Pass& pass, const Range& range, Later& later) const;
    void add_later(const Pass& pass, const std::vector<Later>& later) const;

    const NodeGraph* graph_;
    Beside beside_;
    std::vector<Range> ranges_;
    /// [passes][ranges]: what the rows from `shared` on add to the nodes after them
    std::vector<std::vector<Later>> later_;
    std::vector<std::vector<double>> squares_;  ///< [passes][ranges]
};

}  // namespace thermocontact::fem

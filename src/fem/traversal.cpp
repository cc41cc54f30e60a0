#include "fem/traversal.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace thermocontact::fem {
namespace {

/// Of all nodes, how many the ranges may share before there are less of them.
constexpr int most_shared = 4;

}  // namespace

Pass pass_of(const Product& product) {
    if (product.y == nullptr) {
        return {.add =
                    [&product](NodeRange range, const std::array<Target, 2>&) {
                        return quadratic_form(*product.matrix, range, product.x->data());
                    },
                .square = product.square};
    }
    Pass pass{.results = {Pass::Result{product.y, product.from}}, .add = {}};
    if (product.matrix != nullptr) {
        pass.add = [&product](NodeRange range, const std::array<Target, 2>& results) {
            add_product(*product.matrix, range, product.factor, product.x->data(), results[0].here,
                        results[0].later);
            return 0.0;
        };
    }
    return pass;
}

Traversal::Traversal(const NodeGraph& graph, Beside beside, std::int32_t range_size)
    : graph_(&graph), beside_(std::move(beside)) {
    std::int32_t count = std::max(std::min(1, graph.node_count()), graph.node_count() / range_size);
    for (ranges_ = cut(count); count > 1; ranges_ = cut(count)) {
        std::int64_t shared = 0;
        for (const Range& range : ranges_) {
            shared += range.reach - range.shared;
        }
        if (shared <= graph.node_count() / most_shared) {
            break;
        }
        count /= 2;
    }
}

std::vector<Traversal::Range> Traversal::cut(std::int32_t count) const {
    const auto last = [this](std::int32_t node) {  // of those that it couples with
        return graph_
            ->columns[static_cast<std::size_t>(graph_->offsets[static_cast<std::size_t>(node) + 1]) - 1];
    };
    const std::int32_t nodes = graph_->node_count();
    std::vector<Range> ranges;
    for (std::int32_t i = 0; i < count; ++i) {
        const auto at = [&](std::int32_t number) {
            return static_cast<std::int32_t>(std::int64_t{nodes} * number / count);
        };
        Range range{{at(i), at(i + 1)}, at(i), at(i + 1)};
        while (range.shared < range.all.end && last(range.shared) < range.all.end) {
            ++range.shared;
        }
        for (std::int32_t node = range.shared; node < range.all.end; ++node) {
            range.reach = std::max(range.reach, last(node) + 1);
        }
        if (range.shared == range.all.end) {
            range.reach = range.shared;
        }
        ranges.push_back(range);
    }
    return ranges;
}

void Traversal::each(const std::function<void(NodeRange, std::size_t)>& work) const {
    beside_(static_cast<int>(ranges_.size()), [&](int number) {
        const auto at = static_cast<std::size_t>(number);
        work(ranges_[at].all, at);
    });
}

void Traversal::multiply(std::span<const Product> products) {
    std::vector<Pass> passes;
    passes.reserve(products.size());
    for (const Product& product : products) {
        passes.push_back(pass_of(product));
    }
    run(passes);
}

void Traversal::run(std::span<const Pass> passes) {
    if (later_.size() < passes.size()) {
        later_.resize(passes.size(), std::vector<Later>(ranges_.size()));
        squares_.resize(passes.size(), std::vector<double>(ranges_.size()));
    }
    each([&](NodeRange, std::size_t number) {
        for (std::size_t i = 0; i < passes.size(); ++i) {
            squares_[i][number] = run(passes[i], ranges_[number], later_[i][number]);
        }
    });
    for (std::size_t i = 0; i < passes.size(); ++i) {
        add_later(passes[i], later_[i]);
        if (passes[i].square != nullptr) {
            *passes[i].square = std::accumulate(squares_[i].begin(), squares_[i].end(), 0.0);
        }
    }
}

double Traversal::run(const Pass& pass, const Range& range, Later& later) const {
    std::array<Target, 2> before{}, after{};
    bool any = false;
    for (std::size_t k = 0; k < pass.results.size(); ++k) {
        const auto& [y, from] = pass.results[k];
        if (y == nullptr) {
            continue;
        }
        any = true;
        const auto rows = static_cast<std::ptrdiff_t>(y->size()) / graph_->node_count();
        const std::ptrdiff_t begin = range.all.begin * rows, end = range.all.end * rows;
        if (from != nullptr) {
            std::copy(from->data() + begin, from->data() + end, y->data() + begin);
        } else {
            std::fill(y->data() + begin, y->data() + end, 0.0);
        }
        later[k].assign(pass.add ? static_cast<std::size_t>((range.reach - range.shared) * rows) : 0, 0.0);
        before[k] = {y->data(), y->data()};
        after[k] = {y->data(), later[k].data() - range.shared * rows};
    }
    if (!pass.add) {
        return 0;
    }
    if (!any) {
        return pass.add(range.all, before);
    }
    const double square = pass.add({range.all.begin, range.shared}, before);
    return square + pass.add({range.shared, range.all.end}, after);
}

void Traversal::add_later(const Pass& pass, const std::vector<Later>& later) const {
    for (std::size_t k = 0; k < pass.results.size(); ++k) {
        if (pass.results[k].y == nullptr) {
            continue;
        }
        std::vector<double>& y = *pass.results[k].y;
        for (std::size_t number = 0; number < ranges_.size(); ++number) {
            const auto rows = static_cast<std::ptrdiff_t>(y.size()) / graph_->node_count();
            const std::vector<double>& more = later[number][k];
            double* values = y.data() + std::ptrdiff_t{ranges_[number].shared} * rows;
            for (std::size_t i = 0; i < more.size(); ++i) {
                values[i] += more[i];
            }
        }
    }
}

}  // namespace thermocontact::fem

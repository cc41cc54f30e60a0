#include "fem/traversal.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace thermocontact::fem {
namespace {

/// Of all nodes, how many the ranges may share before there are less of them.
constexpr int most_shared = 4;

}  // namespace

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
    if (later_.size() < products.size()) {
        later_.resize(products.size(), std::vector<std::vector<double>>(ranges_.size()));
        squares_.resize(products.size(), std::vector<double>(ranges_.size()));
    }
    each([&](NodeRange range, std::size_t number) {
        for (std::size_t i = 0; i < products.size(); ++i) {
            const Product& product = products[i];
            if (product.y != nullptr) {
                multiply(product, ranges_[number], later_[i][number]);
            } else {
                squares_[i][number] = quadratic_form(*product.matrix, range, product.x->data());
            }
        }
    });
    for (std::size_t i = 0; i < products.size(); ++i) {
        const Product& product = products[i];
        if (product.y == nullptr) {
            *product.square = std::accumulate(squares_[i].begin(), squares_[i].end(), 0.0);
        } else if (product.matrix != nullptr) {
            for (std::size_t number = 0; number < ranges_.size(); ++number) {
                const std::vector<double>& later = later_[i][number];
                double* y = product.y->data() + std::ptrdiff_t{ranges_[number].shared} * product.matrix->rows;
                for (std::size_t k = 0; k < later.size(); ++k) {
                    y[k] += later[k];
                }
            }
        }
    }
}

void Traversal::multiply(const Product& product, const Range& range, std::vector<double>& later) {
    const auto rows = static_cast<std::ptrdiff_t>(product.y->size()) / graph_->node_count();
    const std::ptrdiff_t begin = range.all.begin * rows, end = range.all.end * rows;
    double* y = product.y->data();
    if (product.from != nullptr) {
        std::copy(product.from->data() + begin, product.from->data() + end, y + begin);
    } else {
        std::fill(y + begin, y + end, 0.0);
    }
    if (product.matrix == nullptr) {
        return;
    }
    later.assign(static_cast<std::size_t>((range.reach - range.shared) * rows), 0.0);
    const double* x = product.x->data();
    add_product(*product.matrix, {range.all.begin, range.shared}, product.factor, x, y, y);
    add_product(*product.matrix, {range.shared, range.all.end}, product.factor, x, y,
                later.data() - range.shared * rows);
}

}  // namespace thermocontact::fem

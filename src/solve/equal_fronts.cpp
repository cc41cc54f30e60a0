#include "solve/equal_fronts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace thermocontact::solve {
namespace {

/// All that a front is made of.
struct Content {
    std::vector<std::uint64_t> words;  ///< what must be equal: sizes, places, children
    std::vector<double> values;        ///< what may differ by round-off
    double largest = 0;                ///< of their magnitudes
};

class Description {
  public:
    explicit Description(const FrontTree& tree) : tree_(&tree) {}

    /// `first` [supernodes before]: the first one with an equal front.
    const Content& of(std::size_t number, std::span<const std::int32_t> first) {
        const Supernode supernode = tree_->supernodes()[number];
        content_.words.assign({static_cast<std::uint64_t>(supernode.columns), supernode.rows.size()});
        content_.values.clear();
        content_.largest = 0;
        tree_->locate(number, local_);
        add_entries(number);
        for (const std::int32_t child : tree_->children(number)) {
            content_.words.push_back(static_cast<std::uint64_t>(first[static_cast<std::size_t>(child)]));
            tree_->places(static_cast<std::size_t>(child), local_, places_);
            content_.words.insert(content_.words.end(), places_.begin(), places_.end());
        }
        return content_;
    }

  private:
    void end_column() {
        std::ranges::sort(column_, {}, &Entry::first);
        for (const auto& [place, value] : column_) {
            content_.words.push_back(static_cast<std::uint64_t>(place));
            content_.values.push_back(value);
            content_.largest = std::max(content_.largest, std::abs(value));
        }
        content_.words.push_back(column_.size());
        column_.clear();
    }

    void add_entries(std::size_t number) {
        std::int32_t last = 0;
        tree_->each_entry(number, local_, [&](std::int32_t column, std::int32_t place, double value) {
            if (column != last) {
                end_column();
                last = column;
            }
            column_.emplace_back(place, value);
        });
        end_column();
    }

    using Entry = std::pair<std::int32_t, double>;

    const FrontTree* tree_;
    std::vector<std::int32_t> local_, places_;
    std::vector<Entry> column_;
    Content content_;
};

/// D. E. Knuth's multiplicative hash of each word and what came before.
std::uint64_t hash(std::span<const std::uint64_t> words) {
    std::uint64_t result = 0;
    for (const std::uint64_t word : words) {
        result = (std::rotl(result, 23) ^ word) * 0x9E3779B97F4A7C15U;
    }
    return result ^ (result >> 32);
}

/// A sum with weights from 1 to 2 that hardly any two fronts have in common: those whose entries are near
/// have sums that are.
double mark(const Content& content) {
    double sum = 0, turn = 0;
    for (const double value : content.values) {
        turn += 0.6180339887498949;  // the golden ratio's fractions fill [0, 1] evenly
        turn -= turn >= 1 ? 1 : 0;
        sum += (1 + turn) * value;
    }
    return sum;
}

bool equal(const Content& one, const Content& other) {
    const double near = equal_entries * one.largest;
    return one.words == other.words &&
           std::ranges::equal(one.values, other.values,
                              [near](double a, double b) { return std::abs(a - b) <= near; });
}

}  // namespace

std::vector<std::int32_t> equal_fronts(const FrontTree& tree, std::int32_t head) {
    const Supernodes& supernodes = tree.supernodes();
    std::vector<std::int32_t> first;
    std::multimap<std::pair<std::uint64_t, double>, std::int32_t> known;
    Description own(tree), other(tree);
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        first.push_back(static_cast<std::int32_t>(s));
        if (supernodes[s].first + supernodes[s].columns > head) {
            continue;
        }
        const Content& content = own.of(s, first);
        const std::uint64_t key = hash(content.words);
        const double here = mark(content);
        if (!std::isfinite(here)) {
            continue;  // where it is factored, this is told
        }
        const double near = 2 * equal_entries * content.largest * static_cast<double>(content.values.size());
        const auto end = known.upper_bound({key, here + near});
        const auto same = std::find_if(known.lower_bound({key, here - near}), end, [&](const auto& entry) {
            return equal(content, other.of(static_cast<std::size_t>(entry.second), first));
        });
        if (same != end) {
            first.back() = same->second;
        } else {
            known.emplace(std::pair(key, here), first.back());
        }
    }
    return first;
}

}  // namespace thermocontact::solve

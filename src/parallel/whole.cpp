#include "parallel/whole.h"

#include <algorithm>

namespace thermocontact::parallel {

std::vector<double> to_whole(const NodeNumbers& numbers, const Team& team,
                             const std::vector<double>& values) {
    if (team.size() == 1) {
        return values;
    }
    const std::size_t nodes = numbers.global.size();
    // a process without nodes does not know
    const std::size_t here = nodes == 0 ? 0 : values.size() / nodes;
    const auto components = static_cast<std::size_t>(team.max(static_cast<double>(here)));
    // every number plus -0 is that number, also 0 and -0
    std::vector<double> whole(static_cast<std::size_t>(numbers.total()) * components, -0.0);
    for (std::size_t i = 0; i < nodes; ++i) {
        if (numbers.owns(i)) {
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                        whole.begin() + static_cast<std::ptrdiff_t>(
                                            static_cast<std::size_t>(numbers.whole[i]) * components));
        }
    }
    team.sum(whole);
    return whole;
}

std::vector<double> from_whole(const NodeNumbers& numbers, const std::vector<double>& whole) {
    const std::size_t components = whole.size() / static_cast<std::size_t>(numbers.total());
    std::vector<double> values;
    values.reserve(numbers.whole.size() * components);
    for (const std::int32_t node : numbers.whole) {
        const auto row =
            whole.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(node) * components);
        values.insert(values.end(), row, row + static_cast<std::ptrdiff_t>(components));
    }
    return values;
}

}  // namespace thermocontact::parallel

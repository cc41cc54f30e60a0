#include "plan/transfer.h"

#include <cmath>
#include <limits>

#include "fem/shape_values.h"
#include "plan/cell_finder.h"

namespace thermocontact::plan {

Transfer::Transfer(const Domain& from, const Domain& to) : offsets_{0} {
    const CellFinder finder(from.spec, from.mesh);
    const auto dimension = static_cast<std::size_t>(from.mesh.dimension);
    std::vector<std::int32_t> cells;
    std::vector<double> places;
    for (const mesh::Point& node : to.space.nodes) {
        const Location location = finder.at(node);
        cells.push_back(location.cell);
        places.insert(places.end(), location.place.begin(),
                      location.place.begin() + static_cast<std::ptrdiff_t>(dimension));
    }
    const std::vector<double> shapes = fem::shape_values(from.mesh.cell, from.space.element.degree, places);
    constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
    std::size_t shape = 0;
    for (const std::int32_t cell : cells) {
        for (const std::int32_t node : from.space.dofmap.of(cell)) {
            if (const double weight = shapes[shape++]; std::abs(weight) > round_off) {
                columns_.push_back(node);
                weights_.push_back(weight);
            }
        }
        offsets_.push_back(columns_.size());
    }
}

std::vector<double> Transfer::operator()(const std::vector<double>& values, int components) const {
    const auto count = static_cast<std::size_t>(components);
    const std::size_t nodes = offsets_.size() - 1;
    std::vector<double> result(values.empty() ? 0 : nodes * count, 0.0);
    for (std::size_t node = 0; node < nodes && !values.empty(); ++node) {
        for (std::size_t entry = offsets_[node]; entry < offsets_[node + 1]; ++entry) {
            const std::size_t source = static_cast<std::size_t>(columns_[entry]) * count;
            for (std::size_t i = 0; i < count; ++i) {
                result[node * count + i] += weights_[entry] * values[source + i];
            }
        }
    }
    return result;
}

}  // namespace thermocontact::plan

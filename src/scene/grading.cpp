// [mesh.grading]: ratios by the names of sides.

#include "mesh/grading.h"

#include <algorithm>
#include <cmath>

#include "number.h"
#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

constexpr std::string_view table = "mesh.grading.";

/// Below it, of the size of the body or its distance from the origin, points lie too close together to tell
/// cells from round-off: two nodes of a mesh file would be taken for one place.
constexpr double thinnest = 2e-10;

std::string key_of(const std::string& side) {
    return std::string(table) + side;
}

double ratio(const Settings& settings, const std::string& side) {
    const Setting* setting = settings.find(key_of(side));
    return setting == nullptr ? 1 : setting->value.get<double>();
}

/// The largest of the body's diagonal and its coordinates.
double size_of(const std::vector<double>& lower, const std::vector<double>& upper) {
    double diagonal = 0, farthest = 0;
    for (std::size_t i = 0; i < lower.size(); ++i) {
        diagonal = std::hypot(diagonal, upper[i] - lower[i]);
        farthest = std::max({farthest, std::abs(lower[i]), std::abs(upper[i])});
    }
    return std::max(diagonal, farthest);
}

void check_thickness(const Settings& settings, std::size_t axis, const std::string& side) {
    const auto lower = settings.value("mesh.lower").get<std::vector<double>>();
    const auto upper = settings.value("mesh.upper").get<std::vector<double>>();
    const auto cells = settings.value("mesh.cells").get<std::vector<int>>();
    const mesh::Axis along{lower[axis], upper[axis], cells[axis], grading_of(settings)[axis]};
    const double size = mesh::smallest_cell(along), least = thinnest * size_of(lower, upper);
    if (size < least) {
        fail_at(settings, key_of(side),
                "expected cells of at least " + short_text(least) + " (m), the smallest has " +
                    short_text(size) + " where the ratio is " + short_text(ratio(settings, side)));
    }
}

}  // namespace

std::vector<Grading> grading_of(const Settings& settings) {
    std::vector<Grading> result;
    const std::vector<std::string>& sides = settings.body.boundaries;  // the lower and upper one of each axis
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings.body.dimension); ++axis) {
        result.push_back({ratio(settings, sides[2 * axis]), ratio(settings, sides[2 * axis + 1])});
    }
    return result;
}

void check_grading(const Settings& settings) {
    const std::vector<std::string>& sides = settings.body.boundaries;
    for (const Entry& entry : settings.document->entries) {
        if (!entry.key.starts_with(table)) {
            continue;
        }
        const std::string side = entry.key.substr(table.size());
        const auto found = std::ranges::find(sides, side);
        if (found == sides.end()) {
            fail_at(settings, entry.key,
                    "the " + settings.body.what + " has no such side; expected " + one_of(sides));
        }
        check_thickness(settings, static_cast<std::size_t>(found - sides.begin()) / 2, side);
    }
}

}  // namespace thermocontact::scene

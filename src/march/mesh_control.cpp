#include "march/mesh_control.h"

#include <algorithm>
#include <cmath>

#include "mesh/equidistribution.h"

namespace thermocontact::march {
namespace {

constexpr double safety = 0.8;
constexpr double worth_joining = 0.7;
constexpr double tighter = 0.7;  ///< an aim that changes nothing
constexpr double looser = 1.2;   ///< an aim that takes too many cells
constexpr int most_aims = 60;

double relative(const model::FieldEstimate& field, double largest) {
    return field.error > 0 ? field.error / std::max(largest, field.noise) : 0.0;
}

}  // namespace

MeshControl::Verdict MeshControl::judge(const fem::ForestSpace& on, const State& whole) const {
    Verdict verdict{model::estimate_error(*scene_, on.mesh, on.space, whole.displacement, whole.velocity,
                                          whole.temperature)};
    // the fields are larger than the discrete ones by what these lack
    const auto size = [](const model::FieldEstimate& field) { return std::hypot(field.size, field.error); };
    const model::FieldEstimate &deformation = verdict.estimate.deformation, &heat = verdict.estimate.heat;
    verdict.deformation_energy = std::max(whole.deformation_energy, size(deformation));
    verdict.heat_energy = std::max(whole.heat_energy, size(heat));
    verdict.error =
        std::max(relative(deformation, verdict.deformation_energy), relative(heat, verdict.heat_energy));
    return verdict;
}

/// In one go no cell is bisected more than d times as often as halves its edges, as the estimate knows
/// nothing of what is inside; none is joined with more than 2^d.
mesh::Forest MeshControl::aimed_at(double tolerance, const fem::ForestSpace& on,
                                   const Verdict& verdict) const {
    const int d = scene_->dimension;
    std::vector<double> wanted(static_cast<std::size_t>(on.mesh.cell_count()), -d);
    const auto take = [&](const model::FieldEstimate& field, double largest) {
        if (field.error <= 0) {
            return;
        }
        const double aim = tolerance * std::max(largest, field.noise);
        const auto bisections = mesh::bisections_wanted(field.squares, aim, scene_->degree, d);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            wanted[i] = std::max(wanted[i], bisections[i]);
        }
    };
    take(verdict.estimate.deformation, verdict.deformation_energy);
    take(verdict.estimate.heat, verdict.heat_energy);
    std::vector<int> levels;
    for (const std::int32_t leaf : on.forest.leaves()) {
        const int more = static_cast<int>(std::lround(std::min(wanted[levels.size()], 2.0 * d)));
        levels.push_back(std::clamp(on.forest.at(leaf).level + more, 0, spec_.max_level));
    }
    return on.forest.with_levels(levels);
}

mesh::Forest MeshControl::within_limits(double tolerance, const fem::ForestSpace& on,
                                        const Verdict& verdict) const {
    mesh::Forest forest = aimed_at(tolerance, on, verdict);
    for (int aim = 0; aim < most_aims && forest.cell_count() > spec_.max_cells; ++aim) {
        tolerance *= looser;
        forest = aimed_at(tolerance, on, verdict);
    }
    return forest;
}

std::optional<mesh::Forest> MeshControl::finer(const fem::ForestSpace& on, const Verdict& verdict) const {
    double tolerance = safety * spec_.tolerance;
    const mesh::Bisections now = on.forest.bisections();
    for (int aim = 0; aim < most_tries; ++aim, tolerance *= tighter) {
        mesh::Forest forest = within_limits(tolerance, on, verdict);
        if (forest.cell_count() > spec_.max_cells) {
            return std::nullopt;  // the base alone has more
        }
        if (forest.bisections() != now) {
            return forest;
        }
    }
    return std::nullopt;
}

std::optional<mesh::Forest> MeshControl::coarser(const fem::ForestSpace& on, const Verdict& verdict) const {
    mesh::Forest forest = within_limits(safety * spec_.tolerance, on, verdict);
    return forest.cell_count() < worth_joining * on.forest.cell_count() ? std::optional(std::move(forest))
                                                                        : std::nullopt;
}

}  // namespace thermocontact::march

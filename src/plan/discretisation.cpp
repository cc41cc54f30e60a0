#include "plan/discretisation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <numeric>
#include <sstream>

#include "scene/text.h"
#include "scene/time_steps.h"

namespace thermocontact::plan {
namespace {

/// Cells in all that a coarsest mesh has at least: with fewer there is no shape to converge.
int fewest_cells(std::size_t dimension) {
    return dimension == 2 ? 8 : 6;
}

const std::string condensed = "condensed";

std::string short_or_exact(double value) {
    std::ostringstream stream;
    stream << std::setprecision(12) << value;
    return stream.str();
}

std::string quoted(const std::string& key, const std::string& value) {
    return key + "=\"" + value + '"';
}

/// The step in as few digits as give the number of steps again.
std::string step_text(double end, int steps) {
    const double exact = end / steps;
    double unit = std::pow(10.0, std::floor(std::log10(exact)));
    for (int digit = 0; digit < 15; ++digit, unit /= 10) {
        const double rounded = std::strtod(short_or_exact(std::round(exact / unit) * unit).c_str(), nullptr);
        if (scene::steps_of(end, rounded) == steps) {
            return short_or_exact(rounded);
        }
    }
    return scene::number_text(exact);
}

}  // namespace

int frames_of(const scene::Scene& scene) {
    return std::max(1, scene.time.steps / std::max(1, scene.output.every));
}

int output_every(int steps, int frames) {
    const int between = steps / instants, most = std::max(1, steps / frames);
    int every = std::min(between, most);
    while (between % every != 0) {
        --every;
    }
    return every;
}

std::vector<int> coarsest_cells(const scene::Scene& scene) {
    const std::vector<int>& cells = scene.mesh.cells;
    int divisor = 0;
    for (const int count : cells) {
        divisor = count > 1 ? std::gcd(divisor, count) : divisor;
    }
    divisor = std::max(divisor, 1);
    const auto divided = [&](int parts) {
        std::vector<int> result;
        result.reserve(cells.size());
        for (const int count : cells) {
            result.push_back(count > 1 ? count / divisor * parts : 1);
        }
        return result;
    };
    const auto total = [](const std::vector<int>& counts) {
        return std::accumulate(counts.begin(), counts.end(), 1.0, std::multiplies<>());
    };
    for (int parts = 1; parts < divisor;
         ++parts) {  // a part of the scene's own mesh: that is among the scales
        std::vector<int> result = divided(parts);
        if (divisor % parts == 0 && total(result) >= fewest_cells(cells.size())) {
            return result;
        }
    }
    return divided(divisor);
}

std::vector<int> scaled_cells(const std::vector<int>& coarsest, const std::vector<int>& scene_cells,
                              int scale, const std::vector<int>& stretch) {
    std::vector<int> result;
    result.reserve(coarsest.size());
    for (std::size_t axis = 0; axis < coarsest.size(); ++axis) {
        const int times = scale * (stretch.empty() ? 1 : stretch[axis]);
        result.push_back(scene_cells[axis] > 1 ? coarsest[axis] * times : 1);
    }
    return result;
}

bool is_condensed(const scene::Scene& scene) {
    return scene.solver.strategy == "auto" && !scene.mesh.file;
}

scene::Scene discretised(scene::Scene scene, const Discretisation& choice) {
    if (!scene.mesh.file) {
        scene.mesh.cells =
            scaled_cells(coarsest_cells(scene), scene.mesh.cells, choice.scale, choice.stretch);
    }
    if (!choice.grading.empty()) {
        scene.mesh.cell = "tensor";
        scene.mesh.grading = choice.grading;
    }
    if (is_condensed(scene)) {
        scene.solver.strategy = condensed;
    }
    scene.degree = choice.degree;
    scene.time.steps = choice.steps;
    scene.time.tolerance = choice.stepping.adaptive ? std::optional(choice.tolerance) : std::nullopt;
    return scene;
}

std::vector<std::string> settings(const Stepping& stepping, double tolerance) {
    std::vector<std::string> result{quoted("time.scheme", stepping.scheme)};
    if (stepping.adaptive) {
        result.push_back("time.tolerance=" + scene::number_text(tolerance));
    }
    return result;
}

std::vector<std::string> settings(const scene::Scene& scene, const Discretisation& choice) {
    std::vector<std::string> result;
    if (!scene.mesh.file) {
        std::string cells;
        for (const int count :
             scaled_cells(coarsest_cells(scene), scene.mesh.cells, choice.scale, choice.stretch)) {
            cells += (cells.empty() ? "" : ",") + std::to_string(count);
        }
        result.push_back("mesh.cells=[" + cells + "]");
    }
    if (!choice.grading.empty()) {
        result.push_back(quoted("mesh.cell", "tensor"));
        for (std::size_t axis = 0; axis < choice.grading.size(); ++axis) {
            const auto add = [&](const std::string& side, double ratio) {
                result.push_back("mesh.grading." + side + "=" + scene::number_text(ratio));
            };
            add(side_names[2 * axis], choice.grading[axis].lower);
            add(side_names[2 * axis + 1], choice.grading[axis].upper);
        }
    }
    result.push_back("space.degree=" + std::to_string(choice.degree));
    if (is_condensed(scene)) {
        result.push_back(quoted("solver.strategy", condensed));
    }
    const std::vector<std::string> of_time = settings(choice.stepping, choice.tolerance);
    result.insert(result.end(), of_time.begin(), of_time.end());
    if (scene.resolved.at("time").contains(
            "step")) {  // what a scene says of its steps can only be said again
        result.push_back("time.step=" + step_text(scene.time.end, choice.steps));
    } else {
        result.push_back("time.steps=" + std::to_string(choice.steps));
    }
    result.push_back("output.every=" + std::to_string(output_every(choice.steps, frames_of(scene))));
    return result;
}

int coarser(int count) {
    for (int divisor = 2; divisor * divisor <= count; ++divisor) {
        if (count % divisor == 0) {
            return count / divisor;
        }
    }
    return 1;
}

Discretisation coarser_in_space(Discretisation choice) {
    choice.scale = coarser(choice.scale);
    return choice;
}

Discretisation coarser_in_time(Discretisation choice) {
    if (choice.stepping.adaptive) {
        choice.tolerance = std::min(tolerance_ratio * choice.tolerance, first_tolerance);
    } else {
        choice.steps = instants * coarser(choice.steps / instants);
    }
    return choice;
}

Discretisation finer_in_space(Discretisation choice) {
    choice.scale *= 2;
    return choice;
}

Discretisation finer_in_time(Discretisation choice) {
    if (choice.stepping.adaptive) {
        choice.tolerance /= tolerance_ratio;
    } else {
        choice.steps *= 2;
    }
    return choice;
}

std::optional<Discretisation> halved_along(const Discretisation& from, std::size_t axis,
                                           const std::vector<int>& scene_cells) {
    Discretisation choice = from;
    if (choice.stretch.empty()) {
        choice.stretch.assign(scene_cells.size(), 1);
    }
    if (scene_cells[axis] == 1 || choice.scale * choice.stretch[axis] % 2 != 0) {
        return std::nullopt;
    }
    if (choice.stretch[axis] % 2 == 0) {
        choice.stretch[axis] /= 2;
    } else {  // half of all, twice of the others
        choice.scale /= 2;
        for (std::size_t other = 0; other < scene_cells.size(); ++other) {
            choice.stretch[other] *= other != axis && scene_cells[other] > 1 ? 2 : 1;
        }
    }
    if (std::ranges::all_of(choice.stretch, [](int times) { return times == 1; })) {
        choice.stretch.clear();
    }
    return choice;
}

Discretisation finer(const Discretisation& choice, bool refinable) {
    return finer_in_time(refinable ? finer_in_space(choice) : choice);
}

std::string kind_of_mesh(int degree, const std::vector<scene::Grading>& grading,
                         const std::vector<int>& stretch) {
    std::string result = "degree " + std::to_string(degree);
    for (std::size_t axis = 0; axis < grading.size(); ++axis) {
        result += (axis == 0 ? " graded " : " ") + scene::number_text(grading[axis].lower) + " " +
                  scene::number_text(grading[axis].upper);
    }
    for (std::size_t axis = 0; axis < stretch.size(); ++axis) {
        result += (axis == 0 ? " stretched " : " ") + std::to_string(stretch[axis]);
    }
    return result;
}

std::string kind_of_mesh(const Discretisation& choice) {
    return kind_of_mesh(choice.degree, choice.grading, choice.stretch);
}

double steepest(const std::vector<scene::Grading>& grading) {
    double largest = 1;
    for (const scene::Grading& axis : grading) {
        largest = std::max({largest, axis.lower, axis.upper});
    }
    return largest;
}

std::string describe(const Stepping& stepping) {
    return stepping.scheme + (stepping.adaptive ? ", adaptive" : "");
}

}  // namespace thermocontact::plan

#include "plan/bench.h"

#include <utility>

#include "error.h"
#include "number.h"
#include "plan/study.h"
#include "scene/reader.h"

namespace thermocontact::plan {
namespace {

constexpr double any_tolerance = 1e-3;
constexpr double share_of_memory = 0.25;  ///< that one pilot may fill

/// About how many unknowns a scene on a rectangle or box has.
double unknowns_of(const scene::Scene& scene) {
    double nodes = 1;
    for (const int count : scene.mesh.cells) {
        nodes *= static_cast<double>(count) * scene.degree + 1;
    }
    return nodes * (scene.dimension + 1);
}

std::string key_of(const Discretisation& choice) {
    return describe(choice.stepping) + " " + kind_of_mesh(choice) + " " + std::to_string(choice.scale) + " " +
           std::to_string(choice.steps) + " " + exact_text(choice.tolerance);
}

}  // namespace

Bench::Bench(SceneSource source, Quantity quantity, const parallel::Backend* backend,
             std::function<void()> check)
    : source_(std::move(source)),
      quantity_(quantity),
      backend_(backend),
      check_(std::move(check)),
      scene_(scene::read_scene(source_.path, source_.overrides)),
      writing_(source_.results.empty() ? Writing{} : measured_writing(source_.results)) {}

/// Read as a run with these settings would be, so that what the scene's own keys mean for it is in it.
const scene::Scene& Bench::template_for(const Stepping& stepping) {
    const std::string name = describe(stepping);
    if (const auto found = templates_.find(name); found != templates_.end()) {
        return found->second;
    }
    std::vector<std::string> overrides = source_.overrides;
    for (const std::string& setting : settings(stepping, any_tolerance)) {
        overrides.push_back(setting);
    }
    return templates_.emplace(name, scene::read_scene(source_.path, overrides)).first->second;
}

bool Bench::can(const Stepping& stepping) {
    if (scene_.time.tolerance && !stepping.adaptive) {
        return false;  // nothing on the command line takes a tolerance back
    }
    try {
        template_for(stepping);
        return true;
    } catch (const SceneError&) {
        return false;
    }
}

bool Bench::fits(const Discretisation& discretisation) {
    const scene::Scene scene = plan::discretised(template_for(discretisation.stepping), discretisation);
    return scene.mesh.file || unknowns_of(scene) <= share_of_memory * most_unknowns();
}

const Pilot* Bench::run(const Discretisation& discretisation) {
    const auto [entry, is_new] = pilots_.try_emplace(key_of(discretisation));
    if (is_new) {
        const scene::Scene scene = plan::discretised(template_for(discretisation.stepping), discretisation);
        if (!fits(discretisation)) {
            failure_ =
                "a pilot of " + exact_text(unknowns_of(scene)) + " unknowns would take too much memory";
            return nullptr;
        }
        try {
            entry->second = run_pilot(scene, discretisation, quantity_, backend_, check_);
        } catch (const NumericsError& error) {
            failure_ = error.what();
        } catch (const SystemError& error) {  // memory
            failure_ = error.what();
        }
    }
    return entry->second ? &*entry->second : nullptr;
}

bool Bench::has(const Discretisation& discretisation) const {
    return pilots_.contains(key_of(discretisation));
}

std::vector<const Pilot*> Bench::pilots() const {
    std::vector<const Pilot*> result;
    for (const auto& [key, pilot] : pilots_) {
        if (pilot) {
            result.push_back(&*pilot);
        }
    }
    return result;
}

}  // namespace thermocontact::plan

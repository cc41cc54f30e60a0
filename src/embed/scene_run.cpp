#include "embed/scene_run.h"

#include <stdexcept>

#include "output/results.h"
#include "output/summary.h"
#include "scene/reader.h"

namespace thermocontact::embed {
namespace {

scene::Scene read(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    scene::Scene scene = scene::read_scene(path, overrides);
    if (scene.solver.strategy == "auto") {  // there is no other here; `resolved` keeps what the scene says
        scene.solver.strategy = "condensed";
    }
    return scene;
}

Values by_name(const march::Record& record) {
    return {record.begin(), record.end()};
}

}  // namespace

struct SceneRun::Parts {
    Parts(const std::filesystem::path& path, const std::vector<std::string>& overrides,
          const std::optional<std::filesystem::path>& folder)
        : scene(read(path, overrides)), simulation(scene) {
        seconds.factor = simulation.factor_seconds();
        seconds.setup = since_start.seconds() - seconds.factor;
        if (folder) {
            results.emplace(output::FolderClaim(*folder, simulation.team()), scene, simulation);
        }
    }

    void advance();
    void close(const std::string& status, const std::string& reason);

    Stopwatch since_start;
    scene::Scene scene;
    march::Simulation simulation;
    output::Seconds seconds;
    std::optional<output::Results> results;
    bool closed = false;
};

void SceneRun::Parts::advance() {
    if (closed || simulation.finished()) {
        throw std::logic_error("a step of a run that is finished or closed");
    }
    try {
        timed(seconds.steps, [&] { simulation.advance(); });
    } catch (const NumericsError& error) {
        close("failed", error.what());
        throw;
    }
    if (results) {
        timed(seconds.output, [&] {
            results->add_step();
            if (results->checkpoint_is_due() && !simulation.finished()) {
                results->add_checkpoint();
            }
        });
    }
}

void SceneRun::Parts::close(const std::string& status, const std::string& reason) {
    if (!results || closed) {
        return;
    }
    timed(seconds.output, [&] {
        results->add_fields();
        results->add_checkpoint();
    });
    seconds.total = since_start.seconds();
    seconds.steps -= simulation.factor_seconds() - seconds.factor;  // for step sizes met on the way
    seconds.factor = simulation.factor_seconds();
    results->finish(status, reason, seconds, output::conditions(simulation));
    closed = true;
}

SceneRun::SceneRun(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                   const std::optional<std::filesystem::path>& results)
    : parts_(std::make_unique<Parts>(scene, overrides, results)) {}

SceneRun::~SceneRun() = default;
SceneRun::SceneRun(SceneRun&&) noexcept = default;
SceneRun& SceneRun::operator=(SceneRun&&) noexcept = default;

void SceneRun::advance() {
    parts_->advance();
}

bool SceneRun::finished() const {
    return parts_->simulation.finished();
}

void SceneRun::close(const std::string& reason) {
    const bool complete = finished();
    parts_->close(complete ? "completed" : "interrupted", complete ? "" : reason);
}

int SceneRun::step() const {
    return parts_->simulation.state().step;
}

double SceneRun::time() const {
    return parts_->simulation.state().time;
}

int SceneRun::dimension() const {
    return parts_->scene.dimension;
}

Values SceneRun::history() {
    return by_name(parts_->simulation.record());
}

Values SceneRun::contact(const std::string& boundary) {
    const auto measures = parts_->simulation.contact_measures();
    const auto found = measures.find(boundary);
    if (found == measures.end()) {
        throw std::out_of_range("no contact on boundary \"" + boundary + '"');
    }
    return by_name(output::contact_values(found->second));
}

const std::vector<std::array<double, 3>>& SceneRun::nodes() const {
    return parts_->simulation.space().nodes;
}

const std::vector<double>& SceneRun::displacement() const {
    return parts_->simulation.state().displacement;
}

const std::vector<double>& SceneRun::velocity() const {
    return parts_->simulation.state().velocity;
}

const std::vector<double>& SceneRun::temperature() const {
    return parts_->simulation.state().temperature;
}

}  // namespace thermocontact::embed

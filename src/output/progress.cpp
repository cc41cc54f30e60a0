#include "output/progress.h"

#include <unistd.h>

#include <cmath>
#include <iostream>

#include "model/physics.h"
#include "number.h"
#include "output/summary.h"

namespace thermocontact::output {
namespace {

constexpr double terminal_interval = 0.1;  ///< s between refreshes of the live line
constexpr double log_interval = 10.0;      ///< s between lines where there is no terminal
constexpr int bar_width = 24;

std::string bar(double share) {
    const int filled = static_cast<int>(std::lround(share * bar_width));
    return "[" + std::string(static_cast<std::size_t>(filled), '#') +
           std::string(static_cast<std::size_t>(bar_width - filled), '.') + "]";
}

std::string percent(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

double value_in(const march::Record& record, const std::string& name) {
    for (const auto& [key, value] : record) {
        if (key == name) {
            return value;
        }
    }
    return 0;
}

}  // namespace

Progress::Progress(const scene::Scene& scene, bool quiet)
    : scene_(&scene), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::header(const march::Simulation& simulation) const {
    if (quiet_) {
        return;
    }
    std::string physics;
    for (const std::string& name : model::physics_of(*scene_)) {
        physics += (physics.empty() ? "" : ", ") + name;
    }
    const parallel::Part& part = simulation.part();
    std::cerr << "thermocontact " << version_text() << "\n";
    if (!scene_->title.empty()) {
        std::cerr << "scene     " << scene_->title << "\n";
    }
    std::cerr << "mesh      " << part.cells << " cells, " << part.vertices << " vertices, degree "
              << scene_->degree << "\n"
              << "unknowns  " << simulation.displacement_unknowns() << " displacement, "
              << simulation.temperature_unknowns() << " temperature\n"
              << "physics   " << physics << "\n"
              << "time      " << scene_->time.steps << " steps to t = " << short_text(scene_->time.end)
              << ", " << scene_->time.scheme << "\n"
              << "solver    " << simulation.strategy().name() << ": " << simulation.why_strategy() << "\n";
    if (simulation.first_step() > 0) {
        std::cerr << "restart   after step " << simulation.first_step()
                  << ", t = " << short_text(simulation.state().time) << "\n";
    }
}

void Progress::step(const march::Simulation& simulation, const march::Record& record) {
    const double now = total_.seconds();
    const double interval = terminal_ ? terminal_interval : log_interval;
    if (quiet_ || (now - last_shown_ < interval && !simulation.finished())) {
        return;
    }
    last_shown_ = now;
    const march::State& state = simulation.state();
    const double share = static_cast<double>(state.step) / scene_->time.steps;
    const double here = static_cast<double>(state.step - simulation.first_step()) /
                        (scene_->time.steps - simulation.first_step());
    std::string text =
        "step " + std::to_string(state.step) + "/" + std::to_string(scene_->time.steps) +
        "  t = " + short_text(state.time) + "  Newton " +
        short_text(value_in(record, "newton_iterations") + value_in(record, "heat_iterations"));
    if (!simulation.surfaces().empty()) {
        text += "  contact " + percent(value_in(record, "contact_fraction"));
    }
    text += "  " + short_text(std::round(10 * now * (1 - here) / here) / 10) + " s left";
    if (terminal_) {
        std::cerr << "\r\033[K" << bar(share) << " " << text << (simulation.finished() ? "\n" : "")
                  << std::flush;
    } else {
        std::cerr << text << "\n";
    }
}

void Progress::line(const std::string& text) const {
    if (!quiet_) {
        std::cerr << text << "\n";
    }
}

}  // namespace thermocontact::output

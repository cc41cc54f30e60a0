#include "app/run.h"

#include <csignal>
#include <iostream>
#include <new>

#include "app/exit_code.h"
#include "error.h"
#include "output/progress.h"
#include "output/results.h"
#include "scene/reader.h"

namespace thermocontact::app {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int signal) {
    caught_signal = signal;
}

/// Marches until the end or a signal.
void march_on(march::Simulation& simulation, output::Results& results, output::Progress& progress,
              output::Seconds& seconds) {
    while (!simulation.finished() && caught_signal == 0) {
        timed(seconds.steps, [&] { simulation.advance(); });
        timed(seconds.output, [&] {
            results.add_step();
            progress.step(simulation);
        });
    }
}

}  // namespace

int run(const RunCommand& command) {
    const Stopwatch total;
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    output::Seconds seconds;
    output::Progress progress(scene, command.quiet);
    march::Simulation simulation(scene);
    seconds.factor = simulation.factor_seconds();
    seconds.setup = total.seconds() - seconds.factor;
    progress.header(simulation);

    std::signal(SIGINT, catch_signal);
    std::signal(SIGTERM, catch_signal);
    std::optional<output::Results> results;
    timed(seconds.output, [&] { results.emplace(command.output, scene, simulation); });
    const auto finish = [&](const std::string& status, const std::string& reason) {
        timed(seconds.output, [&] { results->add_fields(); });
        seconds.total = total.seconds();
        results->finish(status, reason, seconds);
    };
    try {
        march_on(simulation, *results, progress, seconds);
    } catch (const NumericsError& error) {
        finish("failed", error.what());
        throw;
    }
    if (!simulation.finished()) {
        finish("interrupted", "signal " + std::to_string(caught_signal));
        std::cerr << "thermocontact: interrupted after step " << simulation.state().step
                  << "; results so far in " << command.output.string() << "\n";
        return exit_of_signal(caught_signal);
    }
    finish("completed", "");
    progress.line("results   " + command.output.string());
    return exit_completed;
}

}  // namespace thermocontact::app

#include "app/run.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "app/exit_code.h"
#include "error.h"
#include "output/files.h"
#include "output/progress.h"
#include "output/results.h"
#include "scene/reader.h"

namespace thermocontact::app {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int signal) {
    caught_signal = signal;
}

/// Processes that mpirun started for this run (Open MPI, MPICH and their kin say so in the environment).
int process_count() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
        if (const char* value = std::getenv(name); value != nullptr) {
            return std::max(1, std::atoi(value));
        }
    }
    return 1;
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

void refuse_several_processes() {
    if (const int count = process_count(); count > 1) {
        throw SceneError("mpirun started " + std::to_string(count) +
                         " processes, but this version runs on one: start it without mpirun");
    }
}

/// Assembles and factors; a scene that cannot be factored leaves a summary that says so.
std::unique_ptr<march::Simulation> prepare(const scene::Scene& scene, const std::filesystem::path& folder) {
    output::make_folder(folder);  // first: a folder that cannot be written to would waste the work
    try {
        return std::make_unique<march::Simulation>(scene);
    } catch (const NumericsError& error) {
        output::write_setup_failure(folder, scene, error.what());
        throw;
    }
}

}  // namespace

int run(const RunCommand& command) {
    const Stopwatch total;
    refuse_several_processes();
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    output::Progress progress(scene, command.quiet);
    const auto simulation = prepare(scene, command.output);
    output::Seconds seconds;
    seconds.factor = simulation->factor_seconds();
    seconds.setup = total.seconds() - seconds.factor;
    progress.header(*simulation);

    std::signal(SIGINT, catch_signal);
    std::signal(SIGTERM, catch_signal);
    output::Results results =
        timed(seconds.output, [&] { return output::Results(command.output, scene, *simulation); });
    const auto finish = [&](const std::string& status, const std::string& reason) {
        timed(seconds.output, [&] { results.add_fields(); });
        seconds.total = total.seconds();
        results.finish(status, reason, seconds);
    };
    try {
        march_on(*simulation, results, progress, seconds);
    } catch (const NumericsError& error) {
        finish("failed", error.what());
        throw;
    }
    if (!simulation->finished()) {
        finish("interrupted", "signal " + std::to_string(caught_signal));
        std::cerr << "thermocontact: interrupted after step " << simulation->state().step
                  << "; results so far in " << command.output.string() << "\n";
        return exit_of_signal(caught_signal);
    }
    finish("completed", "");
    progress.line("results   " + command.output.string());
    return exit_completed;
}

}  // namespace thermocontact::app

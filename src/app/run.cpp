#include "app/run.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "app/exit_code.h"
#include "app/process_age.h"
#include "error.h"
#include "output/files.h"
#include "output/progress.h"
#include "output/results.h"
#include "parallel/together.h"
#include "scene/reader.h"

namespace thermocontact::app {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void catch_signal(int signal) {
    caught_signal = signal;
}

/// Marches until the end or a signal; returns the signal, or 0.
int march_on(march::Simulation& simulation, output::Results& results, output::Progress& progress,
             output::Seconds& seconds, const parallel::Backend* backend) {
    int signal = 0;
    while (!simulation.finished() && signal == 0) {
        timed(seconds.steps, [&] {
            const parallel::Phase phase(backend, "steps");
            simulation.advance();
        });
        timed(seconds.output, [&] {
            const parallel::Phase phase(backend, "output");
            progress.step(simulation, results.add_step());
        });
        signal = static_cast<int>(simulation.team().max(caught_signal));  // not all catch it in the same step
    }
    return signal;
}

/// Assembles and factors; a scene that cannot be factored leaves a summary that says so.
std::unique_ptr<march::Simulation> prepare(const scene::Scene& scene, const std::filesystem::path& folder,
                                           const parallel::Backend* backend) {
    const bool speaks = parallel::is_first(backend);
    parallel::together(parallel::team_of(backend), [&] {
        if (speaks) {  // before all else: a folder that cannot be written to would waste the work
            output::make_folder(folder);
        }
    });
    try {
        return std::make_unique<march::Simulation>(scene, model::Sources{}, backend);
    } catch (const parallel::BackendNeeded&) {
        parallel::continue_with_petsc();
    } catch (const NumericsError& error) {
        if (speaks) {
            output::write_setup_failure(folder, scene, error.what());
        }
        throw;
    }
}

}  // namespace

int run(const RunCommand& command, const parallel::Backend* backend) {
    const double start = process_age();
    const Stopwatch since_start;
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    if (backend == nullptr && scene.solver.strategy == "newton-krylov") {
        parallel::continue_with_petsc();
    }
    const bool speaks = parallel::is_first(backend);
    output::Progress progress(scene, command.quiet || !speaks);
    const auto simulation = prepare(scene, command.output, backend);
    output::Seconds seconds;
    seconds.factor = simulation->factor_seconds();
    seconds.start = start;
    seconds.setup = since_start.seconds() - seconds.factor;
    progress.header(*simulation);

    std::signal(SIGINT, catch_signal);
    std::signal(SIGTERM, catch_signal);
    output::Results results =
        timed(seconds.output, [&] { return output::Results(command.output, scene, *simulation); });
    const auto finish = [&](const std::string& status, const std::string& reason) {
        timed(seconds.output, [&] { results.add_fields(); });
        seconds.total = start + since_start.seconds();
        seconds.steps -= simulation->factor_seconds() - seconds.factor;  // for step sizes met on the way
        seconds.factor = simulation->factor_seconds();
        results.finish(status, reason, seconds);
    };
    int signal = 0;
    try {
        signal = march_on(*simulation, results, progress, seconds, backend);
    } catch (const NumericsError& error) {
        finish("failed", error.what());
        throw;
    }
    if (!simulation->finished()) {
        finish("interrupted", "signal " + std::to_string(signal));
        if (speaks) {
            std::cerr << "thermocontact: interrupted after step " << simulation->state().step
                      << "; results so far in " << command.output.string() << "\n";
        }
        return exit_of_signal(signal);
    }
    finish("completed", "");
    progress.line("results   " + command.output.string());
    return exit_completed;
}

}  // namespace thermocontact::app

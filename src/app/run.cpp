#include "app/run.h"

#include <array>
#include <iostream>
#include <memory>
#include <optional>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "app/process_age.h"
#include "error.h"
#include "march/adaptive_march.h"
#include "output/folder_claim.h"
#include "output/progress.h"
#include "output/results.h"
#include "parallel/together.h"
#include "scene/reader.h"

namespace thermocontact::app {
namespace {

/// Marches until the end or a signal; returns the signal, or 0.
int march_on(march::AdaptiveMarch& march, output::Results& results, output::Progress& progress,
             output::Seconds& seconds, const parallel::Backend* backend, const RunWatch* watch) {
    int signal = static_cast<int>(march.simulation().team().max(caught_signal()));
    while (!march.simulation().finished() && signal == 0) {
        timed(seconds.steps, [&] {
            const parallel::Phase phase(backend, "steps");
            march.advance();
        });
        march::Simulation& simulation = march.simulation();
        results.follow(simulation, march.mesh_number());
        timed(seconds.output, [&] {
            const parallel::Phase phase(backend, "output");
            const march::Record row = results.add_step();
            progress.step(simulation, row);
            if (watch != nullptr) {
                watch->step(simulation, row);
            }
            // not all catch a signal in the same step, and the first process says when a checkpoint is due
            std::array<double, 2> heard{static_cast<double>(caught_signal()),
                                        results.checkpoint_is_due() ? 1.0 : 0.0};
            simulation.team().max(heard);
            signal = static_cast<int>(heard[0]);
            if (heard[1] > 0 && !simulation.finished() && signal == 0) {
                results.add_checkpoint();
            }
        });
    }
    return signal;
}

/// The checkpoint to go on from; every process reads it, and all of them or none go on.
std::optional<output::Checkpoint> read_earlier(const RunCommand& command, const scene::Scene& scene,
                                               const parallel::Backend* backend) {
    if (!command.restart) {
        return std::nullopt;
    }
    return parallel::together(parallel::team_of(backend),
                              [&] { return output::read_checkpoint(*command.restart, scene); });
}

/// Assembles and factors; a scene that cannot be factored leaves a summary that says so.
std::unique_ptr<march::AdaptiveMarch> prepare(const scene::Scene& scene, const RunCommand& command,
                                              const std::optional<output::Checkpoint>& earlier,
                                              const parallel::Backend* backend) {
    try {
        return std::make_unique<march::AdaptiveMarch>(scene, model::Sources{}, backend,
                                                      earlier ? &earlier->snapshot : nullptr);
    } catch (const parallel::BackendNeeded&) {
        parallel::continue_with_petsc();
    } catch (const NumericsError& error) {
        if (parallel::is_first(backend) && !command.restart) {
            output::write_setup_failure(command.output, scene, error.what());
        }
        throw;
    }
}

}  // namespace

int run(const RunCommand& command, const parallel::Backend* backend, const RunWatch* watch) {
    const double start = process_age();
    const Stopwatch since_start;
    const scene::Scene scene = scene::read_scene(command.scene, command.overrides);
    if (backend == nullptr && scene.solver.strategy == "newton-krylov") {
        parallel::continue_with_petsc();
    }
    catch_interruptions();
    const bool speaks = parallel::is_first(backend);
    output::Progress progress(scene, command.quiet || !speaks);
    const std::optional<output::Checkpoint> earlier = read_earlier(command, scene, backend);
    // before the work, which a folder that cannot be written to would waste
    output::FolderClaim folder(command.output, parallel::team_of(backend));
    const auto march = prepare(scene, command, earlier, backend);
    output::Seconds seconds;
    seconds.factor = march->simulation().factor_seconds();
    seconds.start = start;
    seconds.setup = since_start.seconds() - seconds.factor;
    progress.header(march->simulation());

    output::Results results = timed(seconds.output, [&] {
        return output::Results(std::move(folder), scene, march->simulation(), earlier ? &*earlier : nullptr);
    });
    const auto finish = [&](const std::string& status, const std::string& reason) {
        march::Simulation& simulation = march->simulation();
        results.follow(simulation, march->mesh_number());
        std::vector<output::BalanceCondition> conditions;
        timed(seconds.output, [&] {
            results.add_fields();
            results.add_checkpoint();
            conditions = output::conditions(simulation);
        });
        seconds.total = start + since_start.seconds();
        seconds.steps -= simulation.factor_seconds() - seconds.factor;  // for step sizes met on the way
        seconds.factor = simulation.factor_seconds();
        const bool planned = watch != nullptr && simulation.finished();
        results.finish(status, reason, seconds, conditions,
                       planned ? watch->end(seconds) : nlohmann::ordered_json{});
        if (const std::string text = output::warning(conditions); !text.empty() && speaks && !command.quiet) {
            std::cerr << "thermocontact: warning: " << text << "\n";
        }
    };
    int signal = 0;
    try {
        signal = march_on(*march, results, progress, seconds, backend, watch);
    } catch (const NumericsError& error) {
        finish("failed", error.what());
        throw;
    }
    if (!march->simulation().finished()) {
        finish("interrupted", "signal " + std::to_string(signal));
        if (speaks) {
            std::cerr << "thermocontact: interrupted after step " << march->simulation().state().step
                      << "; results so far in " << command.output.string() << "\n";
        }
        return exit_of_signal(signal);
    }
    finish("completed", "");
    progress.line("results   " + command.output.string());
    return exit_completed;
}

}  // namespace thermocontact::app

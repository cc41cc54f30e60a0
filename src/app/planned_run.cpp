#include "app/planned_run.h"

#include <iostream>
#include <utility>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "app/planning.h"
#include "app/run.h"
#include "error.h"
#include "parallel/together.h"
#include "plan/achieved.h"
#include "plan/report.h"

namespace thermocontact::app {
namespace {

constexpr int most_runs = 3;

/// The run is complete, whatever becomes of the pilot that it is compared with.
std::optional<plan::Achieved> judge(const plan::Plan& plan, plan::Bench& bench, const plan::Pilot& run) {
    try {
        return plan::achieved(plan, bench, run);
    } catch (const Interrupted&) {
        return std::nullopt;
    } catch (const parallel::BackendNeeded&) {
        return std::nullopt;
    }
}

/// Runs what is chosen, compares it with the pilots, and reports; `judged` is the comparison.
int carry_out(const plan::Plan& plan, plan::Bench& bench, const RunCommand& command,
              const parallel::Backend* backend, std::optional<plan::Achieved>& judged) {
    RunCommand chosen = command;
    chosen.request.reset();
    chosen.overrides.insert(chosen.overrides.end(), plan.settings.begin(), plan.settings.end());
    const plan::Discretisation discretisation = plan.chosen->discretisation;
    plan::Recorder recorder(command.request->of, discretisation.steps);
    const RunWatch watch{
        [&](march::Simulation& simulation, const march::Record& row) { recorder.note(simulation, row); },
        [&](const output::Seconds& seconds) {
            const plan::Pilot run{discretisation, recorder.frames(), {}};
            const double taken = seconds.setup + seconds.factor + seconds.steps + seconds.output;
            judged = judge(plan, bench, run);
            if (!command.quiet) {
                std::cout << plan::text(plan, taken, judged);
            }
            return plan::to_json(plan, taken, judged);
        }};
    return run(chosen, backend, &watch);
}

/// A run that turns out to have missed what was asked is made again with what it has taught, as long as that
/// is foreseen to end in the time that the first might have taken; its results take the place of the first's.
int meet(plan::Plan plan, plan::Bench& bench, const RunCommand& command, const parallel::Backend* backend) {
    const double seconds = command.request->budget.value_or(plan::longest_run);
    for (int runs = 1;; ++runs) {
        if (!command.quiet) {
            std::cout << plan::text(plan, command.scene.string());
        }
        std::optional<plan::Achieved> judged;
        const int code = carry_out(plan, bench, command, backend, judged);
        const std::optional<plan::Plan> next =
            code == exit_completed && judged && runs < most_runs
                ? plan::after_miss(plan, *judged, seconds - bench.seconds())
                : std::nullopt;
        if (!next) {
            return code;
        }
        plan = *next;
    }
}

}  // namespace

int planned_run(const RunCommand& command, const parallel::Backend* backend) {
    if (parallel::team_of(backend).size() > 1) {
        throw SceneError(
            "run: --accuracy and --budget plan on one process; start without mpirun, or run what "
            "\"plan\" prints");
    }
    return with_bench({command.scene, command.overrides, command.output}, command.request->of, backend,
                      "interrupted while planning", [&](plan::Bench& bench) {
                          plan::Plan plan = plan::Planner(bench, *command.request, true).make();
                          if (!plan.chosen) {
                              throw NumericsError("run: " + plan.refusal +
                                                  "; nothing was run; \"plan\" tells what can be had");
                          }
                          return meet(std::move(plan), bench, command, backend);
                      });
}

}  // namespace thermocontact::app

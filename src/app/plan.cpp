#include "app/plan.h"

#include <iostream>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "error.h"
#include "parallel/together.h"
#include "plan/report.h"

namespace thermocontact::app {
int plan(const PlanCommand& command, const parallel::Backend* backend) {
    if (parallel::team_of(backend).size() > 1) {
        throw SceneError("plan: runs on one process; start it without mpirun");
    }
    catch_interruptions();
    try {
        plan::Bench bench({command.scene, command.overrides}, command.request.of, backend,
                          throw_if_interrupted);
        const plan::Plan plan = plan::Planner(bench, command.request, false).make();
        std::cout << plan::text(plan, command.scene.string());
        return plan.chosen ? exit_completed : exit_numerics_failed;
    } catch (const parallel::BackendNeeded&) {
        parallel::continue_with_petsc();
    } catch (const Interrupted& interrupted) {
        std::cerr << "thermocontact: plan: interrupted\n";
        return exit_of_signal(interrupted.signal);
    }
}

}  // namespace thermocontact::app

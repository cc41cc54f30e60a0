#include "app/plan.h"

#include <iostream>

#include "app/exit_code.h"
#include "app/planning.h"
#include "error.h"
#include "parallel/together.h"
#include "plan/report.h"

namespace thermocontact::app {

int plan(const PlanCommand& command, const parallel::Backend* backend) {
    if (parallel::team_of(backend).size() > 1) {
        throw SceneError("plan: runs on one process; start it without mpirun");
    }
    const std::filesystem::path here = "results";  // of any name, in the current directory
    return with_bench({command.scene, command.overrides, here}, command.request.of, backend,
                      "plan: interrupted", [&](plan::Bench& bench) -> int {
                          const plan::Plan plan = plan::Planner(bench, command.request, false).make();
                          std::cout << plan::text(plan, command.scene.string());
                          return plan.chosen ? exit_completed : exit_numerics_failed;
                      });
}

}  // namespace thermocontact::app

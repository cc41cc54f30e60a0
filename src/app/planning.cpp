#include "app/planning.h"

#include <iostream>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "error.h"

namespace thermocontact::app {

int with_bench(const plan::SceneSource& scene, plan::Quantity of, const parallel::Backend* backend,
               const std::string& interrupted, const std::function<int(plan::Bench&)>& work) {
    catch_interruptions();
    try {
        plan::Bench bench(scene, of, backend, throw_if_interrupted);
        if (bench.scene().mesh.refinement) {
            throw SceneError(
                scene.path.string() +
                ": mesh.refinement.tolerance: a plan chooses the mesh itself; leave [mesh.refinement] "
                "out, or run without --accuracy and --budget");
        }
        return work(bench);
    } catch (const parallel::BackendNeeded&) {
        parallel::continue_with_petsc();
    } catch (const Interrupted& signal) {
        std::cerr << "thermocontact: " << interrupted << "\n";
        return exit_of_signal(signal.signal);
    }
}

}  // namespace thermocontact::app

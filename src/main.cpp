/// thermocontact: dynamic frictional contact of a thermo-viscoelastic body with a rigid, heat-conducting
/// foundation.

#include <iostream>
#include <memory>
#include <new>

#include "app/blas_threads.h"
#include "app/check.h"
#include "app/exit_code.h"
#include "app/forms.h"
#include "app/heap.h"
#include "app/plan.h"
#include "app/planned_run.h"
#include "app/run.h"
#include "app/view.h"
#include "error.h"
#include "output/summary.h"
#include "parallel/backend.h"
#include "parallel/together.h"
#include "scene/scene_schema.h"

namespace {

using namespace thermocontact;

int execute(const app::RunCommand& command, const parallel::Backend* backend) {
    return command.request ? app::planned_run(command, backend) : app::run(command, backend);
}

int execute(const app::PlanCommand& command, const parallel::Backend* backend) {
    return app::plan(command, backend);
}

int execute(const app::CheckCommand& command, const parallel::Backend*) {
    return app::check(command);
}

int execute(const app::ViewCommand& command, const parallel::Backend*) {
    return app::view(command);
}

int execute(const app::SchemaCommand& command, const parallel::Backend*) {
    std::cout << (command.scene ? scene::print_schema(command.format, *scene::schema_of_scene(
                                                                          *command.scene, command.overrides))
                                : scene::print_schema(command.format));
    return app::exit_completed;
}

int execute(const app::FormsCommand& command, const parallel::Backend*) {
    return app::forms(command);
}

int execute(const app::VersionCommand&, const parallel::Backend*) {
    std::cout << "thermocontact " << output::version_text() << "\n";
    return app::exit_completed;
}

int execute(const app::HelpCommand& command, const parallel::Backend*) {
    std::cout << command.text;
    return app::exit_completed;
}

int report(int code, const std::string& reason) {
    std::cerr << "thermocontact: " << reason << "\n";
    return code;
}

/// An error that all processes meet the first one tells of. One that the others know nothing of is told by
/// the process that meets it, which ends them all.
int fail(const parallel::Backend* backend, int code, const std::string& reason) {
    const bool alone = backend == nullptr || backend->team().size() == 1;
    const bool together = alone || backend->all_meet();
    if (!together || parallel::is_first(backend)) {
        report(code, reason);
    }
    if (!together) {
        backend->abort(code);
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    app::prepare_heap();
    app::keep_blas_to_one_thread();
    std::unique_ptr<parallel::Backend> backend;
    try {
        backend = parallel::open_backend(argc, argv);
        if (!parallel::is_first(backend.get())) {  // what is printed is printed once
            std::cout.setstate(std::ios::failbit);
        }
        return std::visit([&](const auto& command) { return execute(command, backend.get()); },
                          app::parse_command_line(argc, argv));
    } catch (const SceneError& error) {
        return fail(backend.get(), app::exit_bad_input, error.what());
    } catch (const NumericsError& error) {
        return fail(backend.get(), app::exit_numerics_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(backend.get(), app::exit_system_failed, parallel::out_of_memory);
    } catch (const std::exception& error) {
        return fail(backend.get(), app::exit_system_failed, error.what());
    }
}

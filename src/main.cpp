/// thermocontact: dynamic frictional contact of a thermo-viscoelastic body with a rigid, heat-conducting
/// foundation.

#include <iostream>
#include <memory>
#include <new>

#include "app/check.h"
#include "app/exit_code.h"
#include "app/heap.h"
#include "app/run.h"
#include "error.h"
#include "output/summary.h"
#include "parallel/backend.h"
#include "scene/schema.h"

namespace {

using namespace thermocontact;

int execute(const app::RunCommand& command, const parallel::Backend* backend) {
    return app::run(command, backend);
}

int execute(const app::CheckCommand& command, const parallel::Backend*) {
    return app::check(command);
}

int execute(const app::SchemaCommand& command, const parallel::Backend*) {
    std::cout << scene::print_schema(command.format);
    return app::exit_completed;
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

/// Errors of scene and numerics meet all processes alike: the first one tells of them.
int fail_together(const parallel::Backend* backend, int code, const std::string& reason) {
    return parallel::is_first(backend) ? report(code, reason) : code;
}

/// Other errors may meet one process only: it tells, and ends them all.
int fail_alone(const parallel::Backend* backend, const std::string& reason) {
    report(app::exit_system_failed, reason);
    if (backend != nullptr && backend->team().size() > 1) {
        backend->abort(app::exit_system_failed);
    }
    return app::exit_system_failed;
}

}  // namespace

int main(int argc, char** argv) {
    app::prepare_heap();
    std::unique_ptr<parallel::Backend> backend;
    try {
        backend = parallel::open_backend(argc, argv);
        return std::visit([&](const auto& command) { return execute(command, backend.get()); },
                          app::parse_command_line(argc, argv));
    } catch (const SceneError& error) {
        return fail_together(backend.get(), app::exit_bad_input, error.what());
    } catch (const NumericsError& error) {
        return fail_together(backend.get(), app::exit_numerics_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail_alone(backend.get(), "out of memory; use a coarser mesh or degree");
    } catch (const std::exception& error) {
        return fail_alone(backend.get(), error.what());
    }
}
